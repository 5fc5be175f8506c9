// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"
#include "vdbounce/particles/particles.h"

#include <cstddef>
#include <vector>

/// @file
/// Ways of particles that are known without stepping, to measure steps against.

namespace vdbounce::bench {

/// Off the voxels' centres.
inline const Vec3d kBallCentre(0.013, 0.007, 0.003);
constexpr double kBallRadius = 1.0;

struct Impact {
    double time; ///< seconds
    Vec3d place; ///< of the surface, world
};

/// Particles with a radius on their way to the ball, and their first impacts, all within `seconds`. `seed` tells which.
struct Shots {
    Particles particles;
    std::vector<Impact> impacts;
};
Shots shotsAtBall(std::size_t count, double seconds, std::uint64_t seed);

/// Particles at rest on a slope, and how far they slide in `seconds`.
struct Slope {
    Vec3d normal;
    Vec3d down; ///< along the slope
    double friction;
    double way;
    Particles particles;
    Box within; ///< what they see of the slope
};
Slope slidingSlope(std::size_t count, double seconds, std::uint64_t seed);

} // namespace vdbounce::bench
