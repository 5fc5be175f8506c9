// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/mesh_warnings.h"

#include "vdbounce/io/number_text.h"

namespace vdbounce {
namespace {

struct Totals {
    std::size_t open = 0;
    std::size_t nonManifold = 0;
    std::size_t turned = 0;
    std::size_t notOrientable = 0;
};

Totals add(const MeshTopology& topology)
{
    Totals totals;
    for (const MeshTopology::Component& component : topology.components) {
        totals.open += component.openEdges;
        totals.nonManifold += component.nonManifoldEdges;
        totals.turned += component.turned;
        totals.notOrientable += component.orientable ? 0 : 1;
    }
    return totals;
}

std::string counted(std::size_t count, const char* one, const char* many)
{
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string placeText(const Vec3d& p)
{
    const auto text = [](double value) { return numberText(std::round(value * 1e6) * 1e-6); };
    return "(" + text(p.x()) + ", " + text(p.y()) + ", " + text(p.z()) + ")";
}

std::string openText(const Totals& totals, SignMethod method)
{
    return "the mesh is open (" + counted(totals.open, "edge", "edges") +
           " with an odd number of triangles): the sign across its holes is the " + signMethodName(method) +
           " method's guess, and phi jumps there; close the mesh, or use --sign unsigned for a sheet";
}

void warnAboutTriangles(const MeshTopology& topology, const Totals& totals, std::vector<std::string>& warnings)
{
    if (totals.nonManifold > 0)
        warnings.push_back(counted(totals.nonManifold, "edge has", "edges have") + " three triangles or more");
    if (topology.degenerate > 0) {
        warnings.push_back(counted(topology.degenerate, "triangle has", "triangles have") +
                           " a point twice: degenerate, and no part of what tells the sign");
    }
    if (topology.copies > 0) {
        warnings.push_back(counted(topology.copies, "triangle is a duplicate", "triangles are duplicates") +
                           " of others and counted once");
    }
    if (topology.unused > 0)
        warnings.push_back(counted(topology.unused, "point is", "points are") + " unused: no triangle has them");
    if (topology.welded > 0) {
        warnings.push_back(counted(topology.welded, "duplicate point was", "duplicate points were") +
                           " taken as one with others at the same place");
    }
}

} // namespace

void warnAboutMesh(const MeshTopology& topology, const ComponentSigns& signs, double thicknessVx,
                   std::vector<std::string>& warnings)
{
    const Totals totals = add(topology);
    std::size_t sheets = 0;
    for (const SignMethod method : signs.method) sheets += method == SignMethod::Unsigned ? 1 : 0;
    if (totals.open > 0) warnings.push_back(openText(totals, signs.overall));
    if (sheets > 0) {
        warnings.push_back(counted(sheets, "component encloses", "components enclose") +
                           " nothing and became a sheet " + numberText(thicknessVx) +
                           " voxels thick; --thickness sets another, --sign winding takes it for a body");
    }
    if (totals.turned > 0) {
        warnings.push_back(counted(totals.turned, "triangle was", "triangles were") +
                           " oriented opposite to those around, and counted as turned");
    }
    if (totals.notOrientable > 0) {
        warnings.push_back(counted(totals.notOrientable, "component has", "components have") +
                           " faces that cannot all face the same way");
    }
    warnAboutTriangles(topology, totals, warnings);
}

void warnAboutMesh(const MeshTopology& topology, SignMethod method, std::vector<std::string>& warnings)
{
    const Totals totals = add(topology);
    if (totals.open > 0) {
        warnings.push_back(openText(totals, method));
    } else if (!topology.rim.empty()) {
        const std::string found =
            counted(topology.rim.size(), "edge joins", "edges join") + " triangles that face opposite ways";
        warnings.push_back(found + (method == SignMethod::Parity ? ": inside is told by parity, which does not ask them"
                                                                 : "; use --sign auto, which turns them"));
    }
    warnAboutTriangles(topology, totals, warnings);
}

void warnAboutCavities(std::size_t sameWay, std::vector<std::string>& warnings)
{
    if (sameWay == 0) return;
    warnings.push_back(counted(sameWay, "component lies", "components lie") +
                       " wholly inside another and face the same way: taken for the walls of cavities; --sign winding "
                       "takes them for solid");
}

void warnAboutDoubt(const ColumnSigns& signs, bool overlaps, std::vector<std::string>& warnings)
{
    if (signs.holes.voxels > 0) {
        warnings.push_back("the methods disagree on the sign of " + counted(signs.holes.voxels, "voxel", "voxels") +
                           " beside holes; the least certain is at " + placeText(signs.holes.place));
    }
    if (overlaps && signs.overlaps.voxels > 0) {
        warnings.push_back(
            "bodies overlap at " + counted(signs.overlaps.voxels, "voxel", "voxels") + ", the first at " +
            placeText(signs.overlaps.place) +
            ": taken as inside, where parity says outside; phi there is the distance to the nearest face");
    }
}

} // namespace vdbounce
