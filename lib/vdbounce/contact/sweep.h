// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/collider.h"

namespace vdbounce {

/// Where along a straight path a particle first touches a collider.
struct PathHit {
    bool hit = false;
    Vec3d position; ///< the last known free point before the hit; without one the path's end
    std::size_t collider = 0;
};

/// The first point at which a particle that moves from `from` to `to` gets a negative gap.
///
/// `from` must be free. Method, for each collider within its box: conservative advancement by the clearance at each
/// point, which cannot pass a surface, but by at least `shortestStep` (world units), so that a path along a surface
/// ends; then bisection between the last free point and the first that is not (lecture, slide 15: find a sign change,
/// then close in on it). A dip into a collider that is shorter than `shortestStep` along the path may be passed over.
PathHit sweepPath(const ColliderSet& colliders, const Vec3d& from, const Vec3d& to, double radius, double shortestStep);

} // namespace vdbounce
