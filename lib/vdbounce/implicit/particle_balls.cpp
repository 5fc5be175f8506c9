// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/particle_balls.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/parallel.h"
#include "vdbounce/base/voxel_limits.h"
#include "vdbounce/io/number_text.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vdbounce {
namespace {

constexpr std::size_t kParticlesPerBlock = 16384;

constexpr std::size_t kNone = ~std::size_t(0);

// What a block of particles comes to.
struct BlockTally {
    std::size_t balls = 0;
    std::uint64_t notFinite = 0;
    std::uint64_t noRadius = 0;
    std::uint64_t tooSmall = 0;
    std::size_t tooFar = kNone; // the first of them
};

double radiusOf(const Particles& particles, std::size_t i, const BallMaking& making)
{
    return particles.radius.empty() ? making.radius : particles.radius[i];
}

// True where there is a voxel centre within the surface that the ball has alone.
bool holdsVoxel(const Ball& ball, double surface)
{
    const double x = ball.x - std::nearbyint(ball.x);
    const double y = ball.y - std::nearbyint(ball.y);
    const double z = ball.z - std::nearbyint(ball.z);
    const double radius = surface * ball.radius;
    return x * x + y * y + z * z < radius * radius;
}

// Writes a block's balls to the places of its particles, without gaps.
BlockTally makeBlock(const Particles& particles, const BallMaking& making, IndexRange range, Ball* to)
{
    BlockTally tally;
    const double scale = 1.0 / making.voxelSize;
    for (std::size_t i = range.begin; i < range.end; ++i) {
        const Vec3d centre = particles.position[i] * scale;
        const double radius = radiusOf(particles, i, making) * scale;
        if (!centre.allFinite() || !std::isfinite(radius)) {
            ++tally.notFinite;
        } else if (!(radius > 0.0)) {
            ++tally.noRadius;
        } else if (centre.cwiseAbs().maxCoeff() + making.reachPerRadius * radius + making.reachVx > kFarthestVoxel) {
            tally.tooFar = std::min(tally.tooFar, i);
        } else {
            const Ball ball{centre.x(), centre.y(), centre.z(), radius};
            if (!holdsVoxel(ball, making.surface)) ++tally.tooSmall;
            to[tally.balls++] = ball;
        }
    }
    return tally;
}

[[noreturn]] void refuseFar(const Particles& particles, std::size_t i, const BallMaking& making)
{
    const Vec3d& p = particles.position[i];
    throw InputError("particle " + std::to_string(particles.id[i]),
                     "at " + numberText(p.x()) + "," + numberText(p.y()) + "," + numberText(p.z()) + " with radius " +
                         numberText(radiusOf(particles, i, making)) + " it reaches farther than 2^30 voxels",
                     "use larger voxels, or leave it out");
}

} // namespace

ParticleBalls makeBalls(const Particles& particles, const BallMaking& making)
{
    ParticleBalls result;
    result.balls = BallList(particles.size());
    std::vector<BlockTally> tallies(blockCount(particles.size(), kParticlesPerBlock));
    forEachBlock(particles.size(), kParticlesPerBlock, [&](std::size_t block, IndexRange range) {
        tallies[block] = makeBlock(particles, making, range, result.balls.data() + range.begin);
    });
    std::size_t count = 0;
    for (std::size_t block = 0; block < tallies.size(); ++block) {
        const BlockTally& tally = tallies[block];
        if (tally.tooFar != kNone) refuseFar(particles, tally.tooFar, making);
        const Ball* from = result.balls.begin() + block * kParticlesPerBlock;
        if (count != block * kParticlesPerBlock) std::copy(from, from + tally.balls, result.balls.data() + count);
        count += tally.balls;
        result.notFinite += tally.notFinite;
        result.noRadius += tally.noRadius;
        result.tooSmall += tally.tooSmall;
    }
    result.balls.shrink(count);
    return result;
}

} // namespace vdbounce
