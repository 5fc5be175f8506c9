// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/linear_transform.h"
#include "vdbounce/io/openvdb_grid.h"

/// @file
/// Between OpenVDB's transforms and ours.

namespace vdbounce {

/// `transform` must be linear.
LinearTransform toLinearTransform(const openvdb::math::Transform& transform);

/// A scale where it is one, so that others can tell that voxels are cubes.
openvdb::math::Transform::Ptr toOpenVdb(const LinearTransform& transform);

} // namespace vdbounce
