// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/triangle_mesh.h"

#include <algorithm>
#include <cstring>

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

std::uint64_t hashOf(const Vec3d& p)
{
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double plain = p[axis] + 0.0; // minus zero becomes zero
        std::uint64_t bits;
        std::memcpy(&bits, &plain, sizeof(bits));
        hash = (hash ^ bits) * 0x9e3779b97f4a7c15ULL;
        hash ^= hash >> 29;
    }
    return hash;
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

std::vector<std::uint32_t> weldEqual(const std::vector<Vec3d>& points)
{
    constexpr std::uint32_t kNone = 0xffffffffu;
    std::size_t slots = 16;
    while (slots < 2 * points.size()) slots *= 2;
    std::vector<std::uint32_t> table(slots, kNone);
    std::vector<std::uint32_t> first(points.size());
    for (std::uint32_t p = 0; p < points.size(); ++p) {
        std::size_t slot = hashOf(points[p]) & (slots - 1);
        while (table[slot] != kNone && points[table[slot]] != points[p]) slot = (slot + 1) & (slots - 1);
        if (table[slot] == kNone) table[slot] = p;
        first[p] = table[slot];
    }
    return first;
}

void weldEqualPoints(TriangleMesh& mesh)
{
    const std::vector<std::uint32_t> first = weldEqual(mesh.points);
    std::vector<std::uint32_t> newIndex(first.size());
    std::vector<Vec3d> kept;
    for (std::uint32_t p = 0; p < first.size(); ++p) {
        if (first[p] == p) {
            newIndex[p] = static_cast<std::uint32_t>(kept.size());
            kept.push_back(mesh.points[p]);
        }
    }
    for (auto& triangle : mesh.triangles) {
        for (std::uint32_t& p : triangle) p = newIndex[first[p]];
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
