// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/grids.h"
#include "support/random.h"

#include "vdbounce/implicit/grid_csg.h"
#include "vdbounce/io/openvdb_grid.h"

#include <Eigen/Geometry>
#include <openvdb/tools/Prune.h>

namespace vdbounce::test {

/// Signed distance to a box that is turned by `axes`.
inline Phi turnedBox(const Vec3d& half, const Mat3d& axes, const Vec3d& centre)
{
    return [=](const Vec3d& p) {
        const Vec3d d = (axes.transpose() * (p - centre)).cwiseAbs() - half;
        return d.cwiseMax(0.0).norm() + std::min(0.0, d.maxCoeff());
    };
}

inline Mat3d randomRotation(Random& random)
{
    return Eigen::AngleAxisd(random.uniform(0.0, 3.0), random.direction()).toRotationMatrix();
}

/// As a file has it: cubes of nothing but one side are tiles.
inline LevelSetGrid bandLevelSet(const Phi& phi, int side, double halfWidthVx = 3.0,
                                 const openvdb::math::Transform::Ptr& transform = uniformTransform(1.0))
{
    const auto grid = bandGrid(phi, transform, side, halfWidthVx);
    openvdb::tools::prune(grid->tree());
    return levelSet(grid);
}

/// A sphere or a turned box about the origin, within 20 units of it.
inline LevelSetGrid randomSolid(Random& random, double halfWidthVx = 3.0)
{
    const Vec3d centre = 4.0 * random.direction();
    if (random.uniform(0.0, 1.0) < 0.5) return bandLevelSet(sphere(random.uniform(5.0, 11.0), centre), 20, halfWidthVx);
    const Vec3d half(random.uniform(2.0, 8.0), random.uniform(2.0, 8.0), random.uniform(2.0, 8.0));
    return bandLevelSet(turnedBox(half, randomRotation(random), centre), 20, halfWidthVx);
}

inline float valueAt(const LevelSetGrid& grid, const openvdb::Coord& voxel)
{
    return toOpenVdb(grid).tree().getValue(voxel);
}

/// Calls body(voxel) for all voxels within `side` of the origin along every axis.
template <class Body> void forEachVoxelWithin(int side, const Body& body)
{
    for (int x = -side; x <= side; ++x) {
        for (int y = -side; y <= side; ++y) {
            for (int z = -side; z <= side; ++z) body(openvdb::Coord(x, y, z));
        }
    }
}

/// The voxels within `side` that differ in their value or, with `states`, in whether they are active.
inline std::size_t differences(const LevelSetGrid& a, const LevelSetGrid& b, int side, bool states = true)
{
    auto inA = toOpenVdb(a).getConstAccessor();
    auto inB = toOpenVdb(b).getConstAccessor();
    std::size_t count = 0;
    forEachVoxelWithin(side, [&](const openvdb::Coord& voxel) {
        const bool same = inA.getValue(voxel) == inB.getValue(voxel);
        if (!same || (states && inA.isValueOn(voxel) != inB.isValueOn(voxel))) ++count;
    });
    return count;
}

inline LevelSetGrid made(CsgOperation operation, const LevelSetGrid& a, const LevelSetGrid& b,
                         const GridCsgOptions& options = {})
{
    return csg(operation, a, b, options).grid;
}

} // namespace vdbounce::test
