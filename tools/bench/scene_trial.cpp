// SPDX-License-Identifier: Apache-2.0
#include "bench/scene_trial.h"

#include "bench/stopwatch.h"

#include "vdbounce/contact/particle_pass.h"
#include "vdbounce/io/particle_file.h"

#include <algorithm>
#include <cmath>

#include <tbb/global_control.h>

namespace vdbounce::bench {
namespace {

constexpr double kSeconds = 1.0;

// As many as there are in a second, at least one.
int framesInASecond(const Scene& scene)
{
    constexpr double kRounding = 1e-9;
    const double frames = kSeconds / (scene.dt * scene.stepsPerFrame) * (1.0 + kRounding);
    return int(std::clamp(frames, 1.0, double(std::max(1, scene.frames))));
}

// `advance` takes the pass through one frame's steps.
template <class Advance>
void runFrames(const Scene& scene, SceneColliders& loader, int frames, bool hits, Particles& particles,
               Progress& progress, const Advance& advance)
{
    ColliderSet colliders = loader.onTheWayTo(0);
    PassOptions options = passOptions(scene, colliders, particleDefaults(scene, colliders));
    options.hits = hits;
    ParticlePass pass(particles, colliders, options);
    for (int frame = 1; frame <= frames; ++frame) {
        throwIfStopped(progress);
        if (loader.deforming()) {
            colliders = loader.onTheWayTo(frame);
            pass.setColliders(colliders);
        }
        advance(pass);
    }
}

} // namespace

SceneStart startOf(const Scene& scene, const ColliderSet& colliders, std::size_t most, int frames)
{
    const Particles all = readParticles(scene.particleFile);
    const std::size_t count = std::min(all.size(), most);
    std::vector<std::size_t> picked;
    for (std::size_t k = 0; k < count; ++k) picked.push_back(k * all.size() / count);
    SceneStart start{reordered(all, picked), std::min(scene.frames, frames > 0 ? frames : framesInASecond(scene))};
    Particles& particles = start.particles;
    particles.hits.clear();
    const ParticleDefaults defaults = particleDefaults(scene, colliders);
    if (particles.radius.empty()) particles.radius.assign(count, defaults.radius);
    if (particles.mass.empty()) particles.mass.assign(count, defaults.mass);
    return start;
}

SceneOutcome outcomeOf(const Scene& scene, SceneColliders& colliders, const SceneStart& start, Progress& progress)
{
    SceneOutcome outcome;
    outcome.particles = start.particles;
    outcome.firstHit.resize(start.particles.size());
    const Particles& particles = outcome.particles;
    const auto noteKinetic = [&] {
        outcome.mostKinetic = std::max(outcome.mostKinetic, totalEnergy(particles, {}, Vec3d::Zero()));
    };
    noteKinetic();
    // One step at a time: what is remembered of hits is the last.
    const auto advance = [&](ParticlePass& pass) {
        for (int step = 0; step < scene.stepsPerFrame; ++step) {
            outcome.deepest = std::max(outcome.deepest, pass.advance(1).tally.maxPenetration);
            for (std::size_t i = 0; i < particles.size(); ++i) {
                if (outcome.firstHit[i].count == 0) outcome.firstHit[i] = particles.hits[i];
            }
            noteKinetic();
        }
    };
    runFrames(scene, colliders, start.frames, true, outcome.particles, progress, advance);
    outcome.energy = totalEnergy(particles, {}, scene.gravity);
    return outcome;
}

double timeOf(const Scene& scene, SceneColliders& colliders, const SceneStart& start, Progress& progress)
{
    const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
    Particles particles = start.particles;
    double time = 0.0;
    runFrames(scene, colliders, start.frames, false, particles, progress,
              [&](ParticlePass& pass) { time += seconds([&] { pass.advance(scene.stepsPerFrame); }); });
    return time * 1e9 / (double(particles.size()) * double(start.frames) * double(scene.stepsPerFrame));
}

} // namespace vdbounce::bench
