// SPDX-License-Identifier: Apache-2.0
#include "bench/trade_lookups.h"

#include "bench/point_sets.h"
#include "bench/precomputed_gradients.h"
#include "bench/stopwatch.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/base/quantile.h"
#include "vdbounce/field/sample_points.h"

#include <algorithm>
#include <cmath>

#include <tbb/global_control.h>

namespace vdbounce::bench {
namespace {

constexpr std::size_t kPointsPerTask = 1024;

// Points of one repetition, and what is true there.
struct Truth {
    std::vector<Vec3d> points;
    std::vector<double> phi;
    std::vector<Vec3d> normal;
};

Truth truthOf(const TradeSubject& subject, std::vector<Vec3d> points)
{
    Truth truth{std::move(points), {}, {}};
    truth.phi.resize(truth.points.size());
    truth.normal.resize(truth.points.size());
    forEachIndex(truth.points.size(), kPointsPerTask, [&](std::size_t i) {
        truth.phi[i] = subject.phi(truth.points[i]);
        truth.normal[i] = subject.normal(truth.points[i]);
    });
    return truth;
}

struct Spread {
    double mean = 0.0;
    double p99 = 0.0;
    double largest = 0.0;
};

Spread spreadOf(std::vector<double> errors)
{
    Spread spread;
    if (errors.empty()) return spread;
    for (double error : errors) spread.mean += error;
    spread.mean /= double(errors.size());
    spread.largest = *std::max_element(errors.begin(), errors.end());
    spread.p99 = quantile(std::move(errors), kErrorShare);
    return spread;
}

double degreesBetween(const Vec3d& a, const Vec3d& b)
{
    constexpr double kDegrees = 180.0 / 3.14159265358979323846;
    return std::atan2(a.cross(b).norm(), a.dot(b)) * kDegrees;
}

std::vector<std::pair<std::string, double>> errorsOf(const std::vector<PointSample>& samples, const Truth& truth,
                                                     double voxel)
{
    std::vector<double> phi;
    std::vector<double> angle;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        phi.push_back(std::abs(double(samples[i].phi) - truth.phi[i]));
        const Vec3d gradient(samples[i].gradient[0], samples[i].gradient[1], samples[i].gradient[2]);
        if (!truth.normal[i].isZero(0.0)) angle.push_back(degreesBetween(gradient, truth.normal[i]));
    }
    const Spread world = spreadOf(phi);
    const Spread degrees = spreadOf(angle);
    return {{"phi_p99", world.p99},
            {"phi_mean", world.mean},
            {"phi_max", world.largest},
            {"phi_mean_vx", world.mean / voxel},
            {"phi_p99_vx", world.p99 / voxel},
            {"phi_max_vx", world.largest / voxel},
            {"normal_mean_deg", degrees.mean},
            {"normal_max_deg", degrees.largest}};
}

// What is looked up: a field, and gradients of its voxels where they are stored.
struct LookedUp {
    LookedUp(const LevelSetGrid& grid, const TradeSettings& settings) : field(grid, settings.field)
    {
        if (settings.precomputed) gradients.emplace(field);
    }

    std::size_t memoryBytes() const { return gradients ? gradients->memoryBytes() : field.memoryBytes(); }

    void lookUp(const std::vector<Vec3d>& points, std::vector<PointSample>& samples) const
    {
        if (gradients) {
            gradients->sample(points.data(), points.size(), samples.data());
        } else {
            samplePoints(field, points.data(), points.size(), samples.data());
        }
    }

    DistanceField field;
    std::optional<PrecomputedGradients> gradients;
};

TradeCase measure(const LevelSetGrid& grid, const TradeSettings& settings, const std::vector<Truth>& truths)
{
    TradeCase one;
    one.settings = settings;
    for (const Truth& truth : truths) {
        std::optional<LookedUp> body;
        one.cost.buildSeconds.push_back(seconds([&] { body.emplace(grid, settings); }));
        one.settings.voxel = body->field.transform().voxelSize().maxCoeff();
        one.cost.bytes = body->memoryBytes();
        std::vector<PointSample> samples(truth.points.size());
        const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
        one.cost.nsPerParticleStep.push_back(
            nanosecondsAPoint(samples.size(), [&] { body->lookUp(truth.points, samples); }));
        one.addErrors(errorsOf(samples, truth, one.settings.voxel));
    }
    return one;
}

// Of every voxel size.
std::vector<TradeSettings> allSettings()
{
    std::vector<TradeSettings> all;
    for (const Lookup lookup : {Lookup::Nearest, Lookup::Trilinear, Lookup::Cubic}) {
        for (const Normal normal : {Normal::Central, Normal::Analytic}) {
            for (const Storage storage : {Storage::Float, Storage::Half, Storage::Fixed8})
                all.push_back({0.0, {lookup, normal, storage}, {}, {}, {}});
        }
    }
    all.push_back({0.0, {}, {}, {}, {}, true});
    return all;
}

} // namespace

std::vector<TradeCase> tradeLookups(const TradeSubject& subject, const TradeOptions& options, Progress& progress)
{
    const DistanceField finest(subject.grids.front());
    std::vector<Truth> truths;
    for (int r = 0; r < options.repetitions; ++r) {
        const auto seed = std::uint64_t(r) + 1;
        truths.push_back(truthOf(subject, pointsNearSurface(finest, options.points, {-1.0, 1.0}, seed)));
    }
    std::vector<TradeCase> cases;
    for (const LevelSetGrid& grid : subject.grids) {
        for (const TradeSettings& settings : allSettings()) {
            throwIfStopped(progress);
            cases.push_back(measure(grid, settings, truths));
            cases.back().group = subject.name + ", lookups";
        }
    }
    return cases;
}

} // namespace vdbounce::bench
