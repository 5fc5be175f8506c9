// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"

namespace vdbounce {

/// The point of triangle a, b, c that is closest to p; degenerate triangles (a segment, a point) included. Off by a few
/// roundings of the coordinates, in triangles of any shape. Method: Voronoi regions, Ericson, Real-Time Collision
/// Detection, 5.1.5; where the triangle is a hundred times as long as high, in its own frame.
Vec3d closestPointOnTriangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c);

/// The weights of a, b and c, together 1, whose mean is that point: what a quantity given at the corners is there. For
/// slivers those of the nearest point of the longest edge.
Vec3d closestWeights(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c);

/// Signed solid angle of the triangle seen from p, steradians over 4 pi: summed over a closed mesh it is 1 inside and 0
/// outside. Method: Van Oosterom and Strackee 1983.
double windingContribution(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c);

} // namespace vdbounce
