// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/mesh_oracle.h"

#include "vdbounce/base/progress.h"
#include "vdbounce/build/sign_choice.h"
#include "vdbounce/build/topology_memory.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vdbounce {

MeshOracle::MeshOracle(const TriangleMesh& mesh, SignMethod sign, const LinearTransform& transform,
                       double halfThickness)
    : halfThickness_(halfThickness)
{
    if (sign == SignMethod::Unsigned) {
        sheet_ = std::make_unique<const Searchable>(mesh);
        return;
    }
    if (sign != SignMethod::Auto) {
        solid_ = std::make_unique<const Searchable>(mesh);
        // What floods cannot reach holds at least what rays say.
        bodies_.push_back(
            {sign != SignMethod::Winding, 1, boundingBox(mesh), std::make_unique<const Searchable>(mesh)});
        return;
    }
    MeshTopology topology = findTopologyMended(mesh, kTornVx * transform.smallestVoxelSize());
    const ComponentSigns signs = chooseSigns(topology, mesh.points, transform.smallestVoxelSize());
    const std::vector<char> sheet = signs.having(SignMethod::Unsigned);
    std::vector<char> solid(sheet.size());
    std::transform(sheet.begin(), sheet.end(), solid.begin(), [](char flag) { return flag != 0 ? char(0) : char(1); });
    TriangleMesh sheets = partOf(mesh, trianglesOf(topology, sheet));
    TriangleMesh solids = partOf(mesh, trianglesOf(topology, solid));
    if (!sheets.triangles.empty()) sheet_ = std::make_unique<const Searchable>(std::move(sheets));
    if (solids.triangles.empty()) return;
    if (signs.needsRays(topology)) {
        bodies_.push_back({true, 1, boundingBox(solids), std::make_unique<const Searchable>(solids)});
    } else {
        SolidGroups groups = groupSolids(std::move(topology), mesh.points, solid);
        findCavities(groups, findCrossings(groups.mesh, transform, Progress::none()), transform, Progress::none());
        addBodies(groups);
    }
    // Distances are to the mesh as it is, with the triangles that are no part of any component.
    solid_ = std::make_unique<const Searchable>(sheet_ == nullptr ? mesh : std::move(solids));
}

void MeshOracle::addBodies(const SolidGroups& solids)
{
    std::vector<TriangleMesh> parts(solids.groups.size());
    for (std::size_t t = 0; t < solids.mesh.triangles.size(); ++t) {
        if (solids.mesh.group[t] == ClosedMesh::kNone) continue;
        const bool isCap = t >= solids.ownTriangles;
        if (isCap && !solids.groups[solids.mesh.group[t]].capsAreWalls) continue;
        TriangleMesh& part = parts[solids.mesh.group[t]];
        const auto first = static_cast<std::uint32_t>(part.points.size());
        for (std::uint32_t p : solids.mesh.triangles[t]) part.points.push_back(solids.mesh.point(p));
        part.triangles.push_back({first, first + 1, first + 2});
    }
    for (std::size_t g = 0; g < parts.size(); ++g) {
        const Box box = boundingBox(parts[g]);
        bodies_.push_back({solids.groups[g].rule == SolidGroup::Rule::Parity, solids.groups[g].weight, box,
                           std::make_unique<const Searchable>(std::move(parts[g]))});
    }
}

bool MeshOracle::Body::holds(const Vec3d& p) const
{
    if (!box.contains(p)) return false;
    return byParity ? surface->tree.insideByParity(p) : std::abs(surface->tree.windingNumber(p)) > 0.5;
}

double MeshOracle::bodyDistance(const Vec3d& p) const
{
    return solid_ != nullptr ? solid_->tree.closest(p).distance : std::numeric_limits<double>::infinity();
}

double MeshOracle::sheetDistance(const Vec3d& p) const
{
    return sheet_ != nullptr ? sheet_->tree.closest(p).distance - halfThickness_
                             : std::numeric_limits<double>::infinity();
}

bool MeshOracle::inBody(const Vec3d& p) const
{
    int total = 0;
    for (const Body& body : bodies_) total += body.holds(p) ? body.weight : 0;
    return total > 0;
}

} // namespace vdbounce
