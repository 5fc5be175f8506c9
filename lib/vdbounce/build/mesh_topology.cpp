// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/mesh_topology.h"

#include "vdbounce/base/disjoint_sets.h"
#include "vdbounce/build/mesh_edges.h"
#include "vdbounce/build/point_welding.h"
#include "vdbounce/build/triangle_copies.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>

namespace vdbounce {
namespace {

using Triangle = TriangleMesh::Triangle;
constexpr std::uint32_t kNone = MeshTopology::kNone;

bool hasPointTwice(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

class TopologyFinder {
public:
    TopologyFinder(const TriangleMesh& mesh, const std::vector<Vec3d>& points,
                   const std::vector<std::uint32_t>& pointOf)
        : points_(points), use_(mesh.triangles.size(), 1)
    {
        result_.triangles.resize(mesh.triangles.size());
        for (std::size_t t = 0; t < use_.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) result_.triangles[t][k] = pointOf[mesh.triangles[t][k]];
            if (!hasPointTwice(result_.triangles[t])) continue;
            use_[t] = 0;
            ++result_.degenerate;
        }
    }

    MeshTopology find()
    {
        MeshEdges edges(result_.triangles, points_.size(), use_);
        const std::vector<std::uint32_t> copies = findCopies(result_.triangles, edges, use_);
        for (std::uint32_t t : copies) use_[t] = 0;
        result_.copies = copies.size();
        if (!copies.empty()) edges = MeshEdges(result_.triangles, points_.size(), use_);
        nameComponents(edges);
        inspect(edges);
        if (anyDisagree_) turnAround(edges);
        findRim(edges);
        measureComponents(result_, points_);
        return std::move(result_);
    }

    MeshTopology findAsIs()
    {
        const MeshEdges edges(result_.triangles, points_.size(), use_);
        result_.components.resize(1);
        for (char used : use_) result_.component.push_back(used != 0 ? 0 : kNone);
        inspect(edges);
        findRim(edges);
        measureComponents(result_, points_);
        return std::move(result_);
    }

private:
    void nameComponents(const MeshEdges& edges)
    {
        DisjointSets sets(use_.size());
        edges.forEachEdge([&](std::uint32_t, const MeshEdges::Side* first, const MeshEdges::Side* last) {
            for (const auto* side = first + 1; side < last; ++side) sets.join(first->side / 3, side->side / 3);
        });
        result_.component.assign(use_.size(), kNone);
        for (std::uint32_t t = 0; t < use_.size(); ++t) {
            if (use_[t] == 0) continue;
            const std::uint32_t name = sets.find(t); // the smallest, so seen before
            if (name == t) {
                result_.component[t] = static_cast<std::uint32_t>(result_.components.size());
                result_.components.emplace_back();
            } else {
                result_.component[t] = result_.component[name];
            }
        }
    }

    bool runsUpwards(std::uint32_t side) const
    {
        const Triangle& t = result_.triangles[side / 3];
        return t[side % 3] < t[(side + 1) % 3];
    }

    void inspect(const MeshEdges& edges)
    {
        edges.forEachEdge([&](std::uint32_t, const MeshEdges::Side* first, const MeshEdges::Side* last) {
            MeshTopology::Component& component = result_.components[result_.component[first->side / 3]];
            const std::size_t uses = std::size_t(last - first);
            if (uses % 2 == 1) ++component.openEdges;
            if (uses > 2) ++component.nonManifoldEdges;
            if (uses != 2) return;
            if (runsUpwards(first->side) == runsUpwards(first[1].side)) anyDisagree_ = true;
        });
    }

    double areaOf(std::uint32_t t) const
    {
        const Triangle& c = result_.triangles[t];
        return 0.5 * (points_[c[1]] - points_[c[0]]).cross(points_[c[2]] - points_[c[0]]).norm();
    }

    // Walks over each patch of triangles joined along edges of two, turning those that disagree with the first.
    void turnAround(const MeshEdges& edges)
    {
        std::vector<std::uint32_t> neighbour(3 * use_.size(), kNone); // the other side on an edge of two
        edges.forEachEdge([&](std::uint32_t, const MeshEdges::Side* first, const MeshEdges::Side* last) {
            if (last - first != 2) return;
            neighbour[first->side] = first[1].side;
            neighbour[first[1].side] = first->side;
        });
        enum : char { Unseen, Kept, Turned };
        std::vector<char> way(use_.size(), Unseen);
        std::vector<std::uint32_t> patch;
        std::vector<std::uint32_t> toBeTurned;
        for (std::uint32_t seed = 0; seed < use_.size(); ++seed) {
            if (use_[seed] == 0 || way[seed] != Unseen) continue;
            patch.assign(1, seed);
            way[seed] = Kept;
            double kept = 0.0;
            double turned = 0.0;
            for (std::size_t i = 0; i < patch.size(); ++i) {
                const std::uint32_t t = patch[i];
                (way[t] == Kept ? kept : turned) += areaOf(t);
                for (std::uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
                    const std::uint32_t other = neighbour[side];
                    if (other == kNone) continue;
                    const bool agrees = runsUpwards(side) != runsUpwards(other);
                    const char wanted = agrees ? way[t] : (way[t] == Kept ? char(Turned) : char(Kept));
                    if (way[other / 3] == Unseen) {
                        way[other / 3] = wanted;
                        patch.push_back(other / 3);
                    } else if (way[other / 3] != wanted) {
                        result_.components[result_.component[t]].orientable = false;
                    }
                }
            }
            const char toTurn = turned > kept ? char(Kept) : char(Turned);
            for (std::uint32_t t : patch) {
                if (way[t] == toTurn) toBeTurned.push_back(t);
            }
        }
        for (std::uint32_t t : toBeTurned) {
            std::swap(result_.triangles[t][1], result_.triangles[t][2]);
            ++result_.components[result_.component[t]].turned;
        }
    }

    // Which way a side ran is told by where its triangle's corners are now; turning a triangle exchanges the names of
    // its first and last side but not the edges that it lies on.
    int change(std::uint32_t low, const MeshEdges::Side& side) const
    {
        const Triangle& t = result_.triangles[side.side / 3];
        for (std::size_t k = 0; k < 3; ++k) {
            if (t[k] == low && t[(k + 1) % 3] == side.high) return 1;
        }
        return -1;
    }

    void findRim(const MeshEdges& edges)
    {
        edges.forEachEdge([&](std::uint32_t low, const MeshEdges::Side* first, const MeshEdges::Side* last) {
            int net = 0;
            for (const auto* side = first; side < last; ++side) net += change(low, *side);
            if (net == 0) return;
            const std::uint32_t component = result_.component[first->side / 3];
            result_.components[component].bounded = false;
            const std::uint32_t high = first->high;
            result_.rim.push_back(net > 0 ? MeshTopology::RimEdge{low, high, component, std::uint32_t(net)}
                                          : MeshTopology::RimEdge{high, low, component, std::uint32_t(-net)});
        });
    }

    const std::vector<Vec3d>& points_;
    std::vector<char> use_;
    MeshTopology result_;
    bool anyDisagree_ = false;
};

void countPoints(const TriangleMesh& mesh, const std::vector<std::uint32_t>& pointOf, MeshTopology& topology)
{
    for (std::uint32_t p = 0; p < pointOf.size(); ++p) topology.welded += pointOf[p] != p ? 1 : 0;
    std::vector<char> used(mesh.points.size(), 0);
    for (const Triangle& t : mesh.triangles) {
        for (std::uint32_t p : t) used[p] = 1;
    }
    topology.unused = std::size_t(std::count(used.begin(), used.end(), char(0)));
}

} // namespace

std::vector<std::uint32_t> trianglesOf(const MeshTopology& topology, const std::vector<char>& wanted)
{
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t t = 0; t < topology.triangles.size(); ++t) {
        const std::uint32_t component = topology.component[t];
        if (component != kNone && wanted[component] != 0) triangles.push_back(t);
    }
    return triangles;
}

TriangleMesh partOf(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles)
{
    TriangleMesh part;
    part.points = mesh.points;
    part.triangles.reserve(triangles.size());
    for (std::uint32_t t : triangles) part.triangles.push_back(mesh.triangles[t]);
    return part;
}

void measureComponents(MeshTopology& topology, const std::vector<Vec3d>& points)
{
    for (MeshTopology::Component& component : topology.components) {
        component.triangles = 0;
        component.area = component.volume = 0.0;
    }
    std::vector<Vec3d> from(topology.components.size(), Vec3d::Zero());
    for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
        const std::uint32_t number = topology.component[t];
        if (number == kNone) continue;
        const Triangle& c = topology.triangles[t];
        MeshTopology::Component& component = topology.components[number];
        // Volumes are summed from a point of the component, where they cancel best.
        if (component.triangles == 0) from[number] = points[c[0]];
        const Vec3d a = points[c[0]] - from[number];
        const Vec3d b = points[c[1]] - from[number];
        const Vec3d d = points[c[2]] - from[number];
        ++component.triangles;
        component.area += 0.5 * (b - a).cross(d - a).norm();
        component.volume += a.dot(b.cross(d)) / 6.0;
    }
}

MeshTopology findTopology(const TriangleMesh& mesh) { return findTopology(mesh, weldEqual(mesh.points)); }

MeshTopology findTopology(const TriangleMesh& mesh, const std::vector<std::uint32_t>& pointOf)
{
    MeshTopology result = TopologyFinder(mesh, mesh.points, pointOf).find();
    countPoints(mesh, pointOf, result);
    return result;
}

MeshTopology findTopologyAsIs(const TriangleMesh& mesh)
{
    const std::vector<std::uint32_t> pointOf = weldEqual(mesh.points);
    MeshTopology result = TopologyFinder(mesh, mesh.points, pointOf).findAsIs();
    countPoints(mesh, pointOf, result);
    return result;
}

} // namespace vdbounce
