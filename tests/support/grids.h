// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/io/level_set_grid.h"

#include <openvdb/openvdb.h>

#include <functional>

namespace vdbounce::test {

using Phi = std::function<double(const Vec3d&)>; ///< exact signed distance at a world point

/// A narrow-band level set of `phi`: all voxels of [-side, side]^3 (index space) closer than `halfWidth` voxels are
/// active.
openvdb::FloatGrid::Ptr bandGrid(const Phi& phi, const openvdb::math::Transform::Ptr& transform, int side,
                                 double halfWidthVx = 3.0);

/// The same with every voxel of the cube active.
openvdb::FloatGrid::Ptr denseGrid(const Phi& phi, const openvdb::math::Transform::Ptr& transform, int side);

openvdb::math::Transform::Ptr uniformTransform(double voxelSize);

/// world = index * rows + origin, OpenVDB's row vectors.
openvdb::math::Transform::Ptr affineTransform(const Mat3d& rows, const Vec3d& origin);

LevelSetGrid levelSet(const openvdb::FloatGrid::Ptr& grid);

Phi sphere(double radius, const Vec3d& centre = Vec3d::Zero());
Phi halfSpace(const Vec3d& normal, double offset = 0.0);

} // namespace vdbounce::test
