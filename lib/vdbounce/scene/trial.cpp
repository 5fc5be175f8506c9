// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/scene/trial.h"

#include "vdbounce/base/parallel.h"

#include <algorithm>
#include <chrono>

namespace vdbounce {
namespace {

// Neighbours in the file mostly are neighbours in space, which share what they look up: whole pieces are picked.
constexpr std::size_t kPiece = 64;
constexpr std::size_t kMostPieces = 256;
constexpr double kEnoughSeconds = 0.5;

std::vector<std::size_t> someOf(std::size_t count)
{
    const std::size_t pieces = blockCount(count, kPiece);
    const std::size_t picked = std::min(pieces, kMostPieces);
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < picked; ++i) {
        const IndexRange range = blockRange(pieces * i / picked, count, kPiece);
        for (std::size_t k = range.begin; k < range.end; ++k) numbers.push_back(k);
    }
    return numbers;
}

} // namespace

Trial tryOut(const Scene& scene, SceneColliders& loader, const Particles& particles, const ParticleDefaults& defaults)
{
    using Clock = std::chrono::steady_clock;
    Particles some = reordered(particles, someOf(particles.size()));
    ColliderSet colliders = loader.onTheWayTo(0);
    PassOptions options = passOptions(scene, colliders, defaults);
    options.interact = false;
    ParticlePass pass(some, colliders, options);
    Trial trial;
    trial.particles = some.size();
    trial.tally = StepTally(colliders.size());
    double seconds = 0.0;
    double steps = 0.0;
    while (trial.frames < scene.frames && seconds < kEnoughSeconds) {
        ++trial.frames;
        if (loader.deforming()) {
            colliders = loader.onTheWayTo(trial.frames);
            pass.setColliders(colliders);
        }
        const Clock::time_point begin = Clock::now();
        steps += double(some.size()) * scene.stepsPerFrame;
        trial.tally += pass.advance(scene.stepsPerFrame).tally;
        seconds += std::chrono::duration<double>(Clock::now() - begin).count();
    }
    if (steps > 0.0) trial.nsPerParticleStep = seconds * 1e9 / steps;
    return trial;
}

} // namespace vdbounce
