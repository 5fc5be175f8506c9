// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/topology_memory.h"

#include "vdbounce/build/point_welding.h"

#include <algorithm>
#include <utility>

namespace vdbounce {
namespace {

// Points of a rim are moved by less than this part of the edges beside them: never to the next point of the same rim.
constexpr double kOfRimEdge = 0.4;

void weldRim(const TriangleMesh& mesh, const MeshTopology& torn, double distance, std::vector<std::uint32_t>& pointOf)
{
    std::vector<double> reach(mesh.points.size(), 0.0);
    for (const MeshTopology::RimEdge& edge : torn.rim) {
        const double ofEdge = std::min(distance, kOfRimEdge * (mesh.points[edge.from] - mesh.points[edge.to]).norm());
        for (std::uint32_t p : {edge.from, edge.to}) reach[p] = reach[p] > 0.0 ? std::min(reach[p], ofEdge) : ofEdge;
    }
    weldClose(mesh.points, reach, pointOf);
}

// Whether mending closed anything; if so, points are counted as the file has them.
bool mends(MeshTopology& mended, const MeshTopology& torn)
{
    if (mended.rim.size() >= torn.rim.size()) return false;
    mended.welded = torn.welded;
    mended.unused = torn.unused;
    return true;
}

bool facesAgree(const MeshTopology& topology)
{
    return std::all_of(topology.components.begin(), topology.components.end(),
                       [](const MeshTopology::Component& c) { return c.orientable && c.turned == 0; });
}

} // namespace

MeshTopology findTopologyMended(const TriangleMesh& mesh, double distance)
{
    std::vector<std::uint32_t> pointOf = weldEqual(mesh.points);
    MeshTopology torn = findTopology(mesh, pointOf);
    if (torn.rim.empty()) return torn;
    weldRim(mesh, torn, distance, pointOf);
    MeshTopology mended = findTopology(mesh, pointOf);
    return mends(mended, torn) ? mended : torn;
}

bool TopologyMemory::Known::update(const TriangleMesh& mesh, std::vector<std::uint32_t> weld)
{
    if (reusable && weld == pointOf) {
        measureComponents(topology, mesh.points);
        return true;
    }
    topology = findTopology(mesh, weld);
    pointOf = std::move(weld);
    reusable = facesAgree(topology);
    return false;
}

const MeshTopology& TopologyMemory::find(const TriangleMesh& mesh, double distance)
{
    if (mesh.triangles != triangles_) {
        triangles_ = mesh.triangles;
        torn_.reusable = mended_.reusable = false;
    }
    std::vector<std::uint32_t> pointOf = weldEqual(mesh.points);
    bool known = torn_.update(mesh, pointOf);
    const MeshTopology* found = &torn_.topology;
    if (!found->rim.empty()) {
        weldRim(mesh, torn_.topology, distance, pointOf);
        known = mended_.update(mesh, std::move(pointOf)) && known;
        if (mends(mended_.topology, torn_.topology)) found = &mended_.topology;
    }
    reused_ += known ? 1 : 0;
    return *found;
}

} // namespace vdbounce
