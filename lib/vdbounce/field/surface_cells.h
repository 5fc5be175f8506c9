// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/distance_field.h"

#include <vector>

namespace vdbounce {

/// The cells (by the voxel at their low corner) in the leaves of `field` whose 8 voxels have values on both sides of
/// `level`, world units; in the order of the field's leaves.
std::vector<Vec3i> cellsAroundLevel(const DistanceField& field, double level);

} // namespace vdbounce
