// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/ball_list.h"

#include <cstddef>
#include <cstdint>

namespace vdbounce {

/// How far from its centre a ball matters: `perRadius` times its radius and `beyond`, voxels.
struct BallReach {
    double perRadius = 1.0;
    double beyond = 0.0;

    double of(const Ball& ball) const { return perRadius * ball.radius + beyond; }
};

/// The lower and the upper half of a box along each axis, index space.
struct BoxHalves {
    double min[3][2];
    double max[3][2];
};

/// Which of a box's eighths each ball reaches: bit 4 x + 2 y + z of `reached`, x, y and z being 1 in the upper half.
/// A little too far rather than not far enough; the same on every processor.
void findReachedEighths(const Ball* balls, std::size_t count, const BallReach& reach, const BoxHalves& halves,
                        std::uint8_t* reached);

} // namespace vdbounce
