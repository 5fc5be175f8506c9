// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/velocity_grid.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/parallel.h"
#include "vdbounce/base/triangle_distance.h"
#include "vdbounce/io/openvdb_grid.h"
#include "vdbounce/io/vdb_archive.h"

#include <memory>

namespace vdbounce {
namespace {

constexpr std::size_t kLeavesPerTask = 16;

using VelocityLeaf = openvdb::Vec3fTree::LeafNodeType;
using ClosestLeaf = openvdb::Int32Tree::LeafNodeType;

std::unique_ptr<VelocityLeaf> velocityLeaf(const ClosestLeaf& closest, const openvdb::math::Transform& transform,
                                           const TriangleMesh& mesh, const std::vector<Vec3d>& velocities)
{
    auto target = std::make_unique<VelocityLeaf>(closest.origin(), openvdb::Vec3f(0.0f));
    for (auto voxel = closest.cbeginValueOn(); voxel; ++voxel) {
        const openvdb::Vec3d world = transform.indexToWorld(voxel.getCoord());
        const TriangleMesh::Triangle& t = mesh.triangles[std::size_t(*voxel)];
        const Vec3d weights = closestWeights(Vec3d(world.x(), world.y(), world.z()), mesh.points[t[0]],
                                             mesh.points[t[1]], mesh.points[t[2]]);
        const Vec3d v = weights[0] * velocities[t[0]] + weights[1] * velocities[t[1]] + weights[2] * velocities[t[2]];
        target->setValueOn(voxel.pos(), openvdb::Vec3f(float(v.x()), float(v.y()), float(v.z())));
    }
    return target;
}

} // namespace

std::vector<Vec3d> pointVelocities(const TriangleMesh& from, const TriangleMesh& to, double seconds)
{
    if (from.points.size() != to.points.size())
        throw UsageError("point velocities", "the two meshes have different points", "give two frames of one mesh");
    std::vector<Vec3d> velocities(from.points.size());
    for (std::size_t p = 0; p < velocities.size(); ++p) velocities[p] = (to.points[p] - from.points[p]) / seconds;
    return velocities;
}

SidecarGrid velocityGrid(const SidecarGrid& closestGrid, const TriangleMesh& mesh, const std::vector<Vec3d>& velocities)
{
    initializeOpenVdb();
    const auto& closest = static_cast<const openvdb::Int32Grid&>(toOpenVdb(closestGrid));
    std::vector<const ClosestLeaf*> leaves;
    closest.tree().getNodes(leaves);
    std::vector<std::unique_ptr<VelocityLeaf>> made(leaves.size());
    forEachIndex(leaves.size(), kLeavesPerTask,
                 [&](std::size_t i) { made[i] = velocityLeaf(*leaves[i], closest.transform(), mesh, velocities); });
    auto grid = openvdb::Vec3SGrid::create(openvdb::Vec3f(0.0f));
    grid->setName("v");
    grid->setTransform(closest.transform().copy());
    for (auto& leaf : made) grid->tree().addLeaf(leaf.release());
    return toSidecarGrid(grid);
}

} // namespace vdbounce
