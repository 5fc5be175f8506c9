// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

/// @file
/// The vector types used throughout. Positions, velocities and normals are double: a float loses a millionth
/// of a voxel at sixteen voxels from the origin, and a step of a nanosecond would not move a particle at all.

namespace vdbounce {

using Vec3d = Eigen::Vector3d;
using Vec3i = Eigen::Vector3i;
using Mat3d = Eigen::Matrix3d;

} // namespace vdbounce
