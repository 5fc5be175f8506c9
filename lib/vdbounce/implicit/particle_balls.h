// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/ball_list.h"
#include "vdbounce/particles/particles.h"

#include <cstdint>

namespace vdbounce {

/// Particles as balls in index space, and those that are none.
struct ParticleBalls {
    BallList balls; ///< in the order of the particles
    std::uint64_t notFinite = 0;
    std::uint64_t noRadius = 0;
    std::uint64_t tooSmall = 0; ///< of the balls: without a voxel centre within
};

/// How particles become balls.
struct BallMaking {
    double voxelSize;      ///< world units; voxel centres lie at its multiples
    double radius;         ///< world units, of particles without one of their own
    double surface;        ///< at this multiple of its radius a particle alone has its surface
    double reachPerRadius; ///< a particle matters up to this multiple of its radius
    double reachVx;        ///< and so many voxels more
};

/// Throws InputError for a particle that reaches farther than 2^30 voxels from the origin.
ParticleBalls makeBalls(const Particles& particles, const BallMaking& making);

} // namespace vdbounce
