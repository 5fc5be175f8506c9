// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"

#include <algorithm>

namespace vdbounce {

/// What a collision does to a velocity, with Coulomb friction; `w` is relative to the collider, `normal` has unit
/// length and points out of it.
///
/// With w_N = (w.n) n and w_T = w - w_N: where w.n < 0 the normal impulse per mass is dN = -(1 + e) w_N, and friction
/// leaves max(0, 1 - mu |dN| / |w_T|) w_T. Where w does not approach it is returned as it is.
/// Never gains kinetic energy for 0 <= e <= 1. `restitution` 0 is the inelastic contact of the lecture's slide 8. Where
/// friction stops the particle, the result has no tangential part at all, so that what sticks stays exactly where it
/// is.
inline Vec3d respond(const Vec3d& w, const Vec3d& normal, double restitution, double friction)
{
    const double approach = w.dot(normal);
    if (!(approach < 0.0)) return w;
    const Vec3d tangential = w - approach * normal;
    if (friction == 0.0) return tangential - restitution * approach * normal;
    const double slip = tangential.norm();
    const double grip = friction * (1.0 + restitution) * -approach;
    const Vec3d kept = grip >= slip ? Vec3d(Vec3d::Zero()) : Vec3d((1.0 - grip / slip) * tangential);
    return kept - restitution * approach * normal;
}

/// A velocity that gets an impulse per mass along the normal, >= 0, and Coulomb friction for it.
inline Vec3d pushed(const Vec3d& w, const Vec3d& normal, double impulse, double friction)
{
    const double leaving = w.dot(normal);
    const Vec3d tangential = w - leaving * normal;
    const double slip = tangential.norm();
    const double kept = slip > 0.0 ? std::max(0.0, 1.0 - friction * impulse / slip) : 0.0;
    return (leaving + impulse) * normal + kept * tangential;
}

} // namespace vdbounce
