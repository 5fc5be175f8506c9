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

using Errors = std::vector<std::pair<std::string, double>>;

// Where the first impact was, against where it should have been.
Errors impactErrors(const Shots& shots, const FieldPtr& field, const TradeSettings& settings)
{
    const ColliderSet sticky({{"ball", field, 0.0, 0.0, OnHit::Stick}});
    PassOptions options = passOptions(settings);
    options.hits = true;
    Particles particles = shots.particles;
    ParticlePass(particles, sticky, options).advance(stepsOf(settings));
    double place = 0.0;
    double time = 0.0;
    std::size_t hits = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const HitRecord& hit = particles.hits[i];
        const double off = (hit.position - shots.impacts[i].place).norm();
        // What comes out on the other side and hits that has missed.
        if (hit.count == 0 || off > 0.5 * kBallRadius) continue;
        ++hits;
        place += off / settings.voxel;
        time += std::abs(hit.time - shots.impacts[i].time);
    }
    const double count = std::max(1.0, double(hits));
    return {{"place_of_impact_vx", place / count},
            {"time_of_impact_s", time / count},
            {"missed", 1.0 - double(hits) / double(particles.size())}};
}

// Bounces without loss, which are timed.
Errors bounceErrors(const Shots& shots, const FieldPtr& field, const TradeSettings& settings, TradeCost& cost)
{
    const ColliderSet elastic({{"ball", field, 1.0, 0.0}});
    const Vec3d gravity = StepOptions().gravity;
    const double moving = totalEnergy(shots.particles, {}, Vec3d::Zero());
    Particles particles = shots.particles;
    const double before = totalEnergy(particles, {}, gravity);
    const PassReport report = runTimed(particles, elastic, settings, cost);
    return {{"penetration_vx", report.tally.maxPenetration / settings.voxel},
            {"energy_drift", std::abs(totalEnergy(particles, {}, gravity) - before) / moving}};
}

Errors slideErrors(const Slope& slope, const FieldPtr& field, const TradeSettings& settings, TradeCost& cost)
{
    const ColliderSet rough({{"slope", field, 0.0, slope.friction}});
    Particles particles = slope.particles;
    runTimed(particles, rough, settings, cost);
    double error = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const Vec3d way = particles.position[i] - slope.particles.position[i];
        error += std::abs(way.dot(slope.down) / slope.way - 1.0);
    }
    return {{"sliding_distance_relative", error / double(particles.size())}};
}

// `measure(field, settings, cost, way)` tells the errors of one repetition with each of the ways, and adds its costs.
template <class Way, class Measure>
std::vector<TradeCase> measureAll(const std::string& group, const ImplicitField& body, const std::vector<Way>& ways,
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
            for (const Way& way : ways) {
                FieldPtr field;
                one.cost.buildSeconds.push_back(
                    seconds([&] { field = std::make_shared<const DistanceField>(grid, settings.field); }));
                one.cost.bytes = field->memoryBytes();
                one.addErrors(measure(field, settings, one.cost, way));
            }
            cases.push_back(std::move(one));
        }
    }
    return cases;
}

// Other particles in each repetition.
template <class MakeWay> auto waysOf(const TradeOptions& options, const MakeWay& makeWay)
{
    std::vector<decltype(makeWay(options.shots, kSeconds, 1))> ways;
    for (int r = 0; r < options.repetitions; ++r)
        ways.push_back(makeWay(options.shots, kSeconds, std::uint64_t(r) + 1));
    return ways;
}

} // namespace

std::vector<TradeCase> tradeShots(const TradeOptions& options, Progress& progress)
{
    const auto ball = makeField(SphereShape{kBallCentre, kBallRadius});
    return measureAll("shots at a ball, steps", *ball, waysOf(options, shotsAtBall), {}, progress,
                      [](const FieldPtr& field, const TradeSettings& settings, TradeCost& cost, const Shots& shots) {
                          Errors errors = impactErrors(shots, field, settings);
                          const Errors more = bounceErrors(shots, field, settings, cost);
                          errors.insert(errors.end(), more.begin(), more.end());
                          return errors;
                      });
}

std::vector<TradeCase> tradeSlides(const TradeOptions& options, Progress& progress)
{
    const std::vector<Slope> slopes = waysOf(options, slidingSlope);
    const auto plane = makeField(PlaneShape{Vec3d::Zero(), slopes.front().normal});
    SampleFieldOptions sampling;
    sampling.within = Box();
    for (const Slope& slope : slopes) {
        sampling.within->add(slope.within.min);
        sampling.within->add(slope.within.max);
    }
    return measureAll("sliding down a slope, steps", *plane, slopes, sampling, progress,
                      [](const FieldPtr& field, const TradeSettings& settings, TradeCost& cost, const Slope& slope) {
                          return slideErrors(slope, field, settings, cost);
                      });
}

} // namespace vdbounce::bench
