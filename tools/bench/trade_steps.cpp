// SPDX-License-Identifier: Apache-2.0
#include "bench/trade_steps.h"

#include "bench/stopwatch.h"
#include "bench/trade_ways.h"

#include "vdbounce/contact/particle_pass.h"
#include "vdbounce/implicit/sample_field.h"
#include "vdbounce/implicit/shapes.h"

#include <cmath>
#include <memory>

#include <tbb/global_control.h>

namespace vdbounce::bench {
namespace {

constexpr double kSeconds = 1.0;
constexpr double kTimeSteps[] = {1.0 / 50.0, 1.0 / 200.0, 1.0 / 800.0};
constexpr double kUsualTimeStep = 1.0 / 200.0;
constexpr double kVoxels[] = {1.0 / 16.0, 1.0 / 64.0};

using FieldPtr = std::shared_ptr<const DistanceField>;

// What differs from case to case: all ways to step, and all lookups with the usual one.
std::vector<TradeSettings> allSettings(double voxel)
{
    std::vector<TradeSettings> all;
    for (const Scheme scheme : {Scheme::Once, Scheme::Iterate, Scheme::CollideContact}) {
        for (const Sweep sweep : {Sweep::Never, Sweep::Auto, Sweep::Always}) {
            for (const double dt : kTimeSteps) all.push_back({voxel, {}, scheme, sweep, dt});
        }
    }
    for (const Lookup lookup : {Lookup::Nearest, Lookup::Trilinear, Lookup::Cubic}) {
        for (const Normal normal : {Normal::Central, Normal::Analytic}) {
            for (const Storage storage : {Storage::Float, Storage::Half, Storage::Fixed8}) {
                const FieldOptions field{lookup, normal, storage};
                const bool usual =
                    lookup == Lookup::Trilinear && normal == Normal::Central && storage == Storage::Float;
                if (!usual) all.push_back({voxel, field, Scheme::CollideContact, Sweep::Auto, kUsualTimeStep});
            }
        }
    }
    return all;
}

PassOptions passOptions(const TradeSettings& settings)
{
    PassOptions options;
    options.step.dt = *settings.dt;
    options.step.scheme = *settings.scheme;
    options.step.sweep = *settings.sweep;
    return options;
}

int stepsOf(const TradeSettings& settings) { return int(std::lround(kSeconds / *settings.dt)); }

// Runs a second on one thread, and adds what a particle step took.
PassReport runTimed(Particles& particles, const ColliderSet& colliders, const TradeSettings& settings, TradeCost& cost)
{
    const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
    PassReport report;
    const int steps = stepsOf(settings);
    const double time = seconds([&] {
        ParticlePass pass(particles, colliders, passOptions(settings));
        report = pass.advance(steps);
    });
    cost.nsPerParticleStep.push_back(time * 1e9 / (double(particles.size()) * steps));
    return report;
}

// Where the first impact was, against where it should have been.
void addImpactErrors(const Shots& shots, const FieldPtr& field, TradeCase& one)
{
    const ColliderSet sticky({{"ball", field, 0.0, 0.0, OnHit::Stick}});
    PassOptions options = passOptions(one.settings);
    options.hits = true;
    Particles particles = shots.particles;
    ParticlePass(particles, sticky, options).advance(stepsOf(one.settings));
    double place = 0.0;
    double time = 0.0;
    std::size_t hits = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const HitRecord& hit = particles.hits[i];
        const double off = (hit.position - shots.impacts[i].place).norm();
        // What comes out on the other side and hits that has missed.
        if (hit.count == 0 || off > 0.5 * kBallRadius) continue;
        ++hits;
        place += off / one.settings.voxel;
        time += std::abs(hit.time - shots.impacts[i].time);
    }
    const double count = std::max(1.0, double(hits));
    one.errors = {{"place_of_impact_vx", place / count},
                  {"time_of_impact_s", time / count},
                  {"missed", 1.0 - double(hits) / double(particles.size())}};
}

// Bounces without loss.
void addBounceErrors(const Shots& shots, const FieldPtr& field, int repetitions, TradeCase& one)
{
    const ColliderSet elastic({{"ball", field, 1.0, 0.0}});
    const Vec3d gravity = StepOptions().gravity;
    const double moving = totalEnergy(shots.particles, {}, Vec3d::Zero());
    for (int r = 0; r < repetitions; ++r) {
        Particles particles = shots.particles;
        const double before = totalEnergy(particles, {}, gravity);
        const PassReport report = runTimed(particles, elastic, one.settings, one.cost);
        if (r > 0) continue;
        one.errors.emplace_back("penetration_vx", report.tally.maxPenetration / one.settings.voxel);
        one.errors.emplace_back("energy_drift", std::abs(totalEnergy(particles, {}, gravity) - before) / moving);
    }
}

// `measure` fills in errors and costs.
template <class Measure>
std::vector<TradeCase> measureAll(const std::string& group, const ImplicitField& body,
                                  const SampleFieldOptions& sampling, Progress& progress, const Measure& measure)
{
    std::vector<TradeCase> cases;
    for (const double voxel : kVoxels) {
        SampleFieldOptions options = sampling;
        options.voxelSize = voxel;
        const LevelSetGrid grid = sampleField(body, options, progress);
        for (const TradeSettings& settings : allSettings(voxel)) {
            throwIfStopped(progress);
            TradeCase one;
            one.group = group;
            one.settings = settings;
            FieldPtr field;
            one.cost.buildSeconds =
                seconds([&] { field = std::make_shared<const DistanceField>(grid, settings.field); });
            one.cost.bytes = field->memoryBytes();
            measure(field, one);
            cases.push_back(std::move(one));
        }
    }
    return cases;
}

} // namespace

std::vector<TradeCase> tradeShots(const TradeOptions& options, Progress& progress)
{
    const Shots shots = shotsAtBall(options.shots, kSeconds);
    const auto ball = makeField(SphereShape{kBallCentre, kBallRadius});
    return measureAll("shots at a ball, steps", *ball, {}, progress, [&](const FieldPtr& field, TradeCase& one) {
        addImpactErrors(shots, field, one);
        addBounceErrors(shots, field, options.repetitions, one);
    });
}

std::vector<TradeCase> tradeSlides(const TradeOptions& options, Progress& progress)
{
    const Slope slope = slidingSlope(options.shots, kSeconds);
    const auto plane = makeField(PlaneShape{Vec3d::Zero(), slope.normal});
    SampleFieldOptions sampling;
    sampling.within = slope.within;
    return measureAll("sliding down a slope, steps", *plane, sampling, progress,
                      [&](const FieldPtr& field, TradeCase& one) {
                          const ColliderSet rough({{"slope", field, 0.0, slope.friction}});
                          for (int r = 0; r < options.repetitions; ++r) {
                              Particles particles = slope.particles;
                              runTimed(particles, rough, one.settings, one.cost);
                              if (r > 0) continue;
                              double error = 0.0;
                              for (std::size_t i = 0; i < particles.size(); ++i) {
                                  const Vec3d way = particles.position[i] - slope.particles.position[i];
                                  error += std::abs(way.dot(slope.down) / slope.way - 1.0);
                              }
                              one.errors = {{"sliding_distance_relative", error / double(particles.size())}};
                          }
                      });
}

} // namespace vdbounce::bench
