// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"

#include <cstdint>
#include <vector>

namespace vdbounce {

/// Joins points that are closer to each other than the `reach` of both, or that a chain of such joins: all points of
/// `pointOf` (as weldEqual() returns it) that stood for one of them stand for the first. Where `reach` is zero nothing
/// is joined. Linear where no more than a few points are within each other's reach.
void weldClose(const std::vector<Vec3d>& points, const std::vector<double>& reach, std::vector<std::uint32_t>& pointOf);

} // namespace vdbounce
