// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/io/sidecar_grid.h"
#include "vdbounce/io/triangle_mesh.h"

#include <vector>

namespace vdbounce {

/// Velocities of a mesh's points that move from where `from` has them to where `to` has them in `seconds` (> 0), world
/// units a second. Given the frames before and after a frame these are central differences, else one-sided. Throws
/// UsageError where the two have different numbers of points.
std::vector<Vec3d> pointVelocities(const TriangleMesh& from, const TriangleMesh& to, double seconds);

/// A grid of three floats named "v": at every voxel of `closest` (MeshToLevelSetResult::closest) the velocity of the
/// mesh's point closest to the voxel's centre, interpolated linearly over its triangle from `velocities` of the mesh's
/// points. So it is exact, rounded to float, for translations, and for rotations and whatever else is linear in space
/// as far as `velocities` are. Cost: 50 nanoseconds a voxel.
///
/// What collides with sequences takes such a grid for the surface's velocity (see readVelocityField()).
SidecarGrid velocityGrid(const SidecarGrid& closest, const TriangleMesh& mesh, const std::vector<Vec3d>& velocities);

} // namespace vdbounce
