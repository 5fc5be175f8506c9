// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/distance_field.h"

#include <vector>

namespace vdbounce::bench {

/// `count` points within `distanceVx` voxels of the field's surface, in random order.
std::vector<Vec3d> pointsNearSurface(const DistanceField& field, std::size_t count, double distanceVx);

/// `count` points anywhere in the field's box, in random order.
std::vector<Vec3d> pointsInBox(const DistanceField& field, std::size_t count);

/// The same points, those of one leaf after those of the other.
std::vector<Vec3d> inLeafOrder(const DistanceField& field, const std::vector<Vec3d>& points);

} // namespace vdbounce::bench
