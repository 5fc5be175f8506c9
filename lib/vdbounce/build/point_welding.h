// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"

#include <cstdint>
#include <vector>

namespace vdbounce {

/// For each point the first one at the same position, which may be itself. Positions are compared bit by bit, but for
/// the sign of zero. Linear in the number of points.
std::vector<std::uint32_t> weldEqual(const std::vector<Vec3d>& points);

/// Joins those of the marked points that are closer than `distance` to each other, or that a chain of such joins: all
/// points of `pointOf` (as weldEqual() returns it) that stood for one of them stand for the first.
void weldClose(const std::vector<Vec3d>& points, const std::vector<char>& marked, double distance,
               std::vector<std::uint32_t>& pointOf);

} // namespace vdbounce
