// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

/// @file
/// Steps of particles that are too far from everything to touch it. One at a time and as vector code, with the same
/// bits: every sum here has its order written out.

namespace vdbounce {

/// Positions are rounded each time that they are added to; a clearance gives up a few units in the last place for it.
constexpr double kClearanceRounding = 4.0 * std::numeric_limits<double>::epsilon();

/// What free flight needs to know of the steps to come.
struct FlightPlan {
    Vec3d speedUp = Vec3d::Zero(); ///< dt times gravity
    double halfStep = 0.0;         ///< dt / 2
    double range = 0.0;            ///< how far from a surface something begins to act
    const double* reach = nullptr; ///< how far colliders move, for each step
    int steps = 0;
};

/// Takes one step if clearance is longer than it; changes nothing otherwise.
inline bool flyFreely(const FlightPlan& plan, double reach, Vec3d& position, Vec3d& velocity, double& clearance)
{
    const Vec3d after = velocity + plan.speedUp;
    const Vec3d there = position + plan.halfStep * (velocity + after);
    const Vec3d move = there - position;
    const double way = std::sqrt((move.x() * move.x() + move.y() * move.y()) + move.z() * move.z());
    const double size = std::max(std::max(std::abs(there.x()), std::abs(there.y())), std::abs(there.z()));
    const double spent = (way + reach) + kClearanceRounding * size;
    if (!(spent + plan.range < clearance)) return false;
    clearance -= spent;
    position = there;
    velocity = after;
    return true;
}

/// Takes each of `count` particles through as many of the plan's steps as its clearance allows, and says how many in
/// `done`. One whose clearance is negative is left alone. Cost: about a nanosecond a step with AVX2.
void flyFreely(const FlightPlan& plan, Vec3d* positions, Vec3d* velocities, double* clearances, std::size_t count,
               int* done);

} // namespace vdbounce
