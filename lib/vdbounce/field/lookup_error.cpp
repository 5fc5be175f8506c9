// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/lookup_error.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/base/quantile.h"
#include "vdbounce/base/random_numbers.h"
#include "vdbounce/field/leaf_sample.h"
#include "vdbounce/field/sample_points.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace vdbounce {
namespace {

constexpr std::size_t kLeaves = 128; // with what lies around them at most 16,000 blocks, 85 MB of floats
// A quarter of them lies within a voxel of the surface.
constexpr std::size_t kPointsTried = 100'000;
constexpr std::size_t kPointsPerTask = 1024;

std::vector<Vec3d> pointsAtSurface(const DistanceField& field, const std::vector<Vec3i>& leaves, std::uint64_t seed)
{
    std::vector<Vec3d> tried(leaves.empty() ? 0 : kPointsTried);
    std::vector<std::uint8_t> near(tried.size());
    forEachIndex(tried.size(), kPointsPerTask, [&](std::size_t i) {
        const Vec3d at = CounterRandom(seed, i).uniformVector() * double(BlockLayout::kLeafSide);
        tried[i] = field.transform().toWorld(leaves[i % leaves.size()].cast<double>() + at - Vec3d::Constant(0.5));
        near[i] = std::abs(field.phi(tried[i])) < field.voxelSize();
    });
    std::vector<Vec3d> points;
    for (std::size_t i = 0; i < tried.size(); ++i) {
        if (near[i] != 0) points.push_back(tried[i]);
    }
    return points;
}

constexpr double kVoxelMargin = 0.9; // the bunny needs 0.96 from 60 to 150 voxels, the armadillo none

Vec3d normalOf(const PointSample& sample)
{
    return Vec3d(sample.gradient[0], sample.gradient[1], sample.gradient[2]).normalized();
}

std::vector<PointSample> lookUp(const DistanceField& field, const std::vector<Vec3d>& points, Normal normal)
{
    std::vector<PointSample> samples(points.size());
    samplePoints(field, points.data(), points.size(), samples.data(), normal);
    return samples;
}

ChoiceError compare(const FieldOptions& choice, const std::vector<PointSample>& samples,
                    const std::vector<PointSample>& finest, double voxel)
{
    ChoiceError error{choice};
    std::vector<double> phi(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        phi[i] = std::abs(double(samples[i].phi) - double(finest[i].phi));
        error.normal += (normalOf(samples[i]) - normalOf(finest[i])).norm();
    }
    error.phi = quantile(std::move(phi), kErrorShare);
    error.normal *= voxel / std::max(1.0, double(samples.size()));
    return error;
}

LookupErrors measure(const LevelSetGrid& grid, std::uint64_t seed, const std::vector<FieldOptions>& choices)
{
    const std::vector<Vec3i> leaves = sampleLeaves(grid, kLeaves, seed);
    const LevelSetGrid pieces = cutOut(grid, leaves);
    const FieldOptions best{Lookup::Cubic, Normal::Analytic, Storage::Float};
    const DistanceField finest(pieces, best);
    const std::vector<Vec3d> points = pointsAtSurface(finest, leaves, seed);
    const std::vector<PointSample> truth = lookUp(finest, points, best.normal);
    LookupErrors errors;
    errors.voxel = finest.voxelSize();
    errors.leaves = summarize(grid).leaves;
    errors.resolution = estimateResolution(grid, seed);
    std::optional<DistanceField> field;
    for (const FieldOptions& choice : choices) {
        // A field tells both normals.
        const bool same = field && field->options().lookup == choice.lookup &&
                          field->options().storage == choice.storage && choice.lookup == Lookup::Trilinear;
        if (!same) field.emplace(pieces, choice);
        errors.choices.push_back(compare(choice, lookUp(*field, points, choice.normal), truth, errors.voxel));
    }
    return errors;
}

} // namespace

const std::vector<FieldOptions>& choicesByCost()
{
    static const std::vector<FieldOptions> choices = [] {
        std::vector<FieldOptions> all;
        for (const Storage storage : {Storage::Float, Storage::Half, Storage::Fixed8}) {
            for (const Normal normal : {Normal::Analytic, Normal::Central})
                all.push_back({Lookup::Trilinear, normal, storage});
        }
        for (const Storage storage : {Storage::Float, Storage::Half, Storage::Fixed8})
            all.push_back({Lookup::Cubic, Normal::Analytic, storage});
        return all;
    }();
    return choices;
}

double LookupErrors::of(const FieldOptions& choice) const
{
    const auto same = [&](const ChoiceError& e) { return e.choice == choice; };
    const ChoiceError& error = *std::find_if(choices.begin(), choices.end(), same);
    return std::max(error.phi + resolution.error, error.normal);
}

double LookupErrors::reachable() const
{
    double least = of(choices.front().choice);
    for (const ChoiceError& error : choices) least = std::min(least, of(error.choice));
    return least;
}

double LookupErrors::voxelFor(double error) const
{
    // The finer the voxels, the more of the errors are those at edges, of order 1.
    const double beyondEdges = resolution.order - 1.0;
    const double order = 1.0 + beyondEdges * beyondEdges;
    return kVoxelMargin * voxel * std::pow(error / reachable(), 1.0 / order);
}

LookupErrors measureLookupErrors(const LevelSetGrid& grid, std::uint64_t seed)
{
    return measure(grid, seed, choicesByCost());
}

LookupErrors measureLookupErrors(const LevelSetGrid& grid, std::uint64_t seed, const FieldOptions& choice)
{
    return measure(grid, seed, {choice});
}

} // namespace vdbounce
