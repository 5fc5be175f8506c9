// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/triangle_copies.h"

#include <algorithm>
#include <utility>

namespace vdbounce {
namespace {

using Triangle = TriangleMesh::Triangle;

struct Twin {
    Triangle sorted; // its corners
    std::uint32_t triangle;

    bool operator<(const Twin& o) const { return sorted != o.sorted ? sorted < o.sorted : triangle < o.triangle; }
    bool operator==(const Twin& o) const { return triangle == o.triangle; }
};

// Even permutations of the sorted corners face one way, odd ones the other.
bool facesLikeSorted(const Triangle& t, const Triangle& sorted)
{
    return (t[0] == sorted[0] && t[1] == sorted[1]) || (t[0] == sorted[1] && t[1] == sorted[2]) ||
           (t[0] == sorted[2] && t[1] == sorted[0]);
}

// Triangles that share an edge, and the point across it, with another one.
std::vector<Twin> findTwins(const std::vector<Triangle>& triangles, const MeshEdges& edges)
{
    std::vector<Twin> twins;
    const auto add = [&](std::uint32_t t) {
        Triangle sorted = triangles[t];
        std::sort(sorted.begin(), sorted.end());
        twins.push_back({sorted, t});
    };
    std::vector<std::pair<std::uint32_t, std::uint32_t>> around; // the point across, the triangle
    edges.forEachEdge([&](std::uint32_t, const MeshEdges::Side* first, const MeshEdges::Side* last) {
        if (last - first < 2) return;
        around.clear();
        for (const auto* side = first; side < last; ++side) {
            const std::uint32_t t = side->side / 3;
            around.emplace_back(triangles[t][(side->side % 3 + 2) % 3], t);
        }
        std::sort(around.begin(), around.end());
        for (std::size_t i = 1; i < around.size(); ++i) {
            if (around[i].first != around[i - 1].first) continue;
            add(around[i - 1].second);
            add(around[i].second);
        }
    });
    std::sort(twins.begin(), twins.end());
    twins.erase(std::unique(twins.begin(), twins.end()), twins.end());
    return twins;
}

} // namespace

std::vector<std::uint32_t> findCopies(const std::vector<Triangle>& triangles, const MeshEdges& edges,
                                      const std::vector<char>& use)
{
    const std::vector<Twin> twins = findTwins(triangles, edges);
    std::vector<std::uint32_t> copies;
    std::vector<std::uint32_t> backToBack;
    bool seen[2] = {false, false}; // facing either way
    for (std::size_t i = 0; i < twins.size(); ++i) {
        if (i == 0 || twins[i].sorted != twins[i - 1].sorted) seen[0] = seen[1] = false;
        const std::size_t way = facesLikeSorted(triangles[twins[i].triangle], twins[i].sorted) ? 1 : 0;
        if (seen[way]) {
            copies.push_back(twins[i].triangle);
        } else if (seen[1 - way]) {
            backToBack.push_back(twins[i].triangle);
        }
        seen[way] = true;
    }
    const auto used = std::size_t(std::count(use.begin(), use.end(), char(1)));
    if (twins.size() == used) copies.insert(copies.end(), backToBack.begin(), backToBack.end());
    std::sort(copies.begin(), copies.end());
    return copies;
}

} // namespace vdbounce
