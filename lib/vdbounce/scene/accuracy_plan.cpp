// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/scene/accuracy_plan.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/memory_limit.h"
#include "vdbounce/io/grid_file.h"
#include "vdbounce/io/number_text.h"
#include "vdbounce/io/particle_file.h"
#include "vdbounce/scene/accuracy_cache.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace vdbounce {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr std::uint64_t kOtherSeed = 2;

struct Measured {
    std::string name;
    LookupErrors errors;
};

std::string levelSetFile(const ColliderSpec& collider, int frame)
{
    return collider.sequence.empty() ? collider.file : framePath(collider.sequence, frame);
}

bool isLevelSet(const ColliderSpec& collider)
{
    return collider.blobs || !collider.file.empty() || !collider.sequence.empty();
}

LevelSetGrid levelSetOf(const ColliderSpec& collider, int frame)
{
    if (!collider.blobs) return readLevelSet(levelSetFile(collider, frame));
    return makeBlobs(readParticles(collider.blobs->file), collider.blobs->options).grid;
}

std::vector<Measured> measureAll(const Scene& scene, int frame)
{
    std::vector<Measured> all;
    for (const ColliderSpec& collider : scene.colliders) {
        if (!isLevelSet(collider)) continue;
        if (collider.blobs) {
            all.push_back(
                {"collider '" + collider.name + "'", measureLookupErrors(levelSetOf(collider, frame), kSeed)});
        } else {
            const std::string file = levelSetFile(collider, frame);
            all.push_back({file, lookupErrorsOf(file)});
        }
    }
    return all;
}

double errorOf(const std::vector<Measured>& all, const FieldOptions& choice)
{
    double error = 0.0;
    for (const Measured& one : all) error = std::max(error, one.errors.of(choice));
    return error;
}

bool fits(const std::vector<Measured>& all, const FieldOptions& choice)
{
    const double quarter = double(defaultMaxMemory()) / 3.0; // that is three of them
    double bytes = 0.0;
    for (const Measured& one : all)
        bytes += double(one.errors.leaves) * double(BlockValues::bytesPerBlock(choice.storage));
    return bytes <= quarter;
}

// To two digits.
double rounded(double value, double (*direction)(double))
{
    const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
    return direction(value / unit) * unit;
}

double up(double value) { return rounded(value, std::ceil); }
double down(double value) { return rounded(value, std::floor); }

std::string shortText(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", value);
    return text;
}

[[noreturn]] void throwUnreachable(const std::vector<Measured>& all, double asked, double voxel)
{
    const auto least = [](const Measured& a, const Measured& b) { return a.errors.reachable() < b.errors.reachable(); };
    const Measured& worst = *std::max_element(all.begin(), all.end(), least);
    const double reachable = worst.errors.reachable();
    throw ToleranceError(worst.name,
                         "no lookup in it is known to be within max_error, " + shortText(asked) + " (" +
                             shortText(asked / voxel) + "vx); the best reaches " + shortText(up(reachable)) + " (" +
                             shortText(up(reachable / voxel)) + "vx)",
                         "make it with voxels of " + shortText(down(worst.errors.voxelFor(asked))) +
                             " or allow a max_error of " + shortText(up(reachable)));
}

} // namespace

std::optional<AccuracyPlan> planAccuracy(const Scene& scene, int frame)
{
    if (!scene.maxError) return std::nullopt;
    const std::vector<Measured> all = measureAll(scene, frame);
    AccuracyPlan plan;
    if (all.empty()) return plan;
    plan.voxel = std::min_element(all.begin(), all.end(), [](const Measured& a, const Measured& b) {
                     return a.errors.voxel < b.errors.voxel;
                 })->errors.voxel;
    const double asked = scene.maxError->world(plan.voxel);
    std::vector<FieldOptions> choices = choicesByCost();
    // Those that fit come first, in the order that they have.
    std::stable_partition(choices.begin(), choices.end(), [&](const FieldOptions& c) { return fits(all, c); });
    for (const FieldOptions& choice : choices) {
        plan.error = errorOf(all, choice);
        plan.chosen = choice;
        if (plan.error <= asked) return plan;
    }
    throwUnreachable(all, asked, plan.voxel);
}

double measuredError(const Scene& scene, int frame)
{
    double error = 0.0;
    for (const ColliderSpec& collider : scene.colliders) {
        if (!isLevelSet(collider)) continue;
        const LevelSetGrid grid = levelSetOf(collider, frame);
        error = std::max(error, measureLookupErrors(grid, kOtherSeed, scene.accuracy).of(scene.accuracy));
    }
    return error;
}

} // namespace vdbounce
