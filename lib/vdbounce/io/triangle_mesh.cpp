// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/triangle_mesh.h"

#include <algorithm>
#include <numeric>

#include <tbb/parallel_sort.h>

namespace vdbounce {
namespace {

struct DirectedEdge {
    std::uint32_t low;
    std::uint32_t high;
    bool upwards; // from low to high

    bool sameEdge(const DirectedEdge& other) const { return low == other.low && high == other.high; }
    bool operator<(const DirectedEdge& other) const { return low != other.low ? low < other.low : high < other.high; }
};

bool isDegenerate(const TriangleMesh::Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

std::vector<DirectedEdge> sortedEdges(const TriangleMesh& mesh)
{
    std::vector<DirectedEdge> edges;
    edges.reserve(mesh.triangles.size() * 3);
    for (const auto& t : mesh.triangles) {
        if (isDegenerate(t)) continue;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t a = t[c];
            const std::uint32_t b = t[(c + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), a < b});
        }
    }
    tbb::parallel_sort(edges.begin(), edges.end());
    return edges;
}

bool lessByPosition(const Vec3d& a, const Vec3d& b)
{
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

} // namespace

Box boundingBox(const TriangleMesh& mesh)
{
    Box box;
    for (const auto& triangle : mesh.triangles) {
        for (std::uint32_t p : triangle) box.add(mesh.points[p]);
    }
    return box;
}

void weldEqualPoints(TriangleMesh& mesh)
{
    const std::size_t count = mesh.points.size();
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    tbb::parallel_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        if (lessByPosition(mesh.points[a], mesh.points[b])) return true;
        if (lessByPosition(mesh.points[b], mesh.points[a])) return false;
        return a < b;
    });

    // The first of each run of equal points stands for all of them.
    std::vector<std::uint32_t> representative(count);
    for (std::size_t i = 0; i < count; ++i) {
        const bool startsRun = i == 0 || mesh.points[order[i]] != mesh.points[order[i - 1]];
        representative[order[i]] = startsRun ? order[i] : representative[order[i - 1]];
    }
    std::vector<std::uint32_t> newIndex(count);
    std::vector<Vec3d> kept;
    for (std::uint32_t p = 0; p < count; ++p) {
        if (representative[p] == p) {
            newIndex[p] = static_cast<std::uint32_t>(kept.size());
            kept.push_back(mesh.points[p]);
        }
    }
    for (auto& triangle : mesh.triangles) {
        for (std::uint32_t& p : triangle) p = newIndex[representative[p]];
    }
    mesh.points = std::move(kept);
}

EdgeReport inspectEdges(const TriangleMesh& mesh)
{
    const std::vector<DirectedEdge> edges = sortedEdges(mesh);
    EdgeReport report;
    for (std::size_t begin = 0; begin < edges.size();) {
        std::size_t end = begin + 1;
        while (end < edges.size() && edges[end].sameEdge(edges[begin])) ++end;
        const std::size_t uses = end - begin;
        if (uses == 1) ++report.open;
        if (uses > 2) ++report.nonManifold;
        if (uses == 2 && edges[begin].upwards == edges[begin + 1].upwards) ++report.inconsistent;
        begin = end;
    }
    return report;
}

} // namespace vdbounce
