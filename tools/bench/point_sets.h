// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"
#include "vdbounce/base/interval.h"
#include "vdbounce/field/distance_field.h"

#include <vector>

namespace vdbounce::bench {

/// `count` points whose phi in voxels lies in `phiVx`, which holds 0, in random order. `seed` tells which.
std::vector<Vec3d> pointsNearSurface(const DistanceField& field, std::size_t count, const Interval& phiVx,
                                     std::uint64_t seed = 1);

/// `count` points anywhere in the field's box, in random order.
std::vector<Vec3d> pointsInBox(const DistanceField& field, std::size_t count);

/// `count` points of a world box where phi > `distance` (world units), in random order.
std::vector<Vec3d> pointsOutside(const DistanceField& field, const Box& box, double distance, std::size_t count);

/// The same points, those of one leaf after those of the other.
std::vector<Vec3d> inLeafOrder(const DistanceField& field, const std::vector<Vec3d>& points);

} // namespace vdbounce::bench
