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

// Steps between looks at the clock: a tenth of a second where each particle touches something in each.
constexpr int kStepsAtOnce = 10;

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

Trial tryOut(const Scene& scene, SceneColliders& loader, const Particles& particles, const ParticleDefaults& defaults,
             int firstFrame, int frames, Progress& progress)
{
    using Clock = std::chrono::steady_clock;
    const auto since = [](Clock::time_point begin) {
        return std::chrono::duration<double>(Clock::now() - begin).count();
    };
    Particles some = reordered(particles, someOf(particles.size()));
    ColliderSet colliders = loader.onTheWayTo(firstFrame);
    PassOptions options = passOptions(scene, colliders, defaults);
    options.interact = false;
    options.firstStep = std::uint64_t(firstFrame) * std::uint64_t(scene.stepsPerFrame);
    ParticlePass pass(some, colliders, options);
    Trial trial;
    trial.particles = some.size();
    trial.tally = StepTally(colliders.size());
    const Clock::time_point begin = Clock::now();
    double stepping = 0.0;
    for (int frame = 0; frame < frames && since(begin) < kEnoughSeconds; ++frame) {
        if (loader.deforming()) {
            colliders = loader.onTheWayTo(firstFrame + frame + 1);
            pass.setColliders(colliders);
        }
        for (int step = 0; step < scene.stepsPerFrame && since(begin) < kEnoughSeconds; step += kStepsAtOnce) {
            const int together = std::min(kStepsAtOnce, scene.stepsPerFrame - step);
            const Clock::time_point before = Clock::now();
            trial.tally += pass.advance(together, progress).tally;
            stepping += since(before);
            trial.steps += std::uint64_t(together);
        }
    }
    const double all = double(some.size()) * double(trial.steps);
    if (all > 0.0) trial.nsPerParticleStep = stepping * 1e9 / all;
    return trial;
}

} // namespace vdbounce
