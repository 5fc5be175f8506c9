// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/scene/accuracy_plan.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/memory_limit.h"
#include "vdbounce/base/voxel_limits.h"
#include "vdbounce/io/grid_file.h"
#include "vdbounce/io/number_text.h"
#include "vdbounce/io/particle_file.h"
#include "vdbounce/scene/accuracy_cache.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace vdbounce {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr std::uint64_t kOtherSeed = 2;

struct Measured {
    std::string name;
    LookupErrors errors;
};

// Of a sequence the first, whichever frames are run: all runs of a scene take the same choice.
std::string levelSetFile(const ColliderSpec& collider)
{
    return collider.sequence.empty() ? collider.file : framePath(collider.sequence, 0);
}

bool isLevelSet(const ColliderSpec& collider)
{
    return collider.blobs || !collider.file.empty() || !collider.sequence.empty();
}

LevelSetGrid levelSetOf(const ColliderSpec& collider)
{
    if (!collider.blobs) return readLevelSet(levelSetFile(collider));
    return makeBlobs(readParticles(collider.blobs->file), collider.blobs->options).grid;
}

std::vector<Measured> measureAll(const Scene& scene)
{
    std::vector<Measured> all;
    for (const ColliderSpec& collider : scene.colliders) {
        if (!isLevelSet(collider)) continue;
        if (collider.blobs) {
            all.push_back({"collider '" + collider.name + "'", measureLookupErrors(levelSetOf(collider), kSeed)});
        } else {
            const std::string file = levelSetFile(collider);
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
    if (!(value >= std::numeric_limits<double>::min())) return value;
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

std::string inBoth(double error, double voxel) { return shortText(error) + " (" + shortText(error / voxel) + "vx)"; }

[[noreturn]] void throwUnreachable(const std::vector<Measured>& all, double asked, double reachable, double voxel)
{
    const auto least = [](const Measured& a, const Measured& b) { return a.errors.reachable() < b.errors.reachable(); };
    const Measured& worst = *std::max_element(all.begin(), all.end(), least);
    const std::string within = "no lookup in it is known to be within max_error, " + inBoth(asked, voxel);
    if (!std::isfinite(worst.errors.reachable())) {
        throw ToleranceError(worst.name,
                             within + ": its band is thinner than 3 voxels or its surface has too few of them",
                             "make it with a band of 3 voxels or more, and smaller ones");
    }
    const double wanted = down(worst.errors.voxelFor(asked * std::min(1.0, worst.errors.reachable() / reachable)));
    const std::string allow = "allow a max_error of " + shortText(up(reachable));
    throw ToleranceError(worst.name, within + "; the best reaches " + inBoth(up(reachable), voxel),
                         wanted < kSmallestVoxel ? allow
                                                 : "make it with voxels of about " + shortText(wanted) +
                                                       " and ask for " + shortText(asked) + ", or " + allow);
}

// On another sample.
double measuredError(const Scene& scene, const FieldOptions& choice)
{
    double error = 0.0;
    for (const ColliderSpec& collider : scene.colliders) {
        if (!isLevelSet(collider)) continue;
        error = std::max(error, measureLookupErrors(levelSetOf(collider), kOtherSeed, choice).of(choice));
    }
    return error;
}

double askedOf(const Scene& scene, double voxel)
{
    if (scene.maxError->inVoxels && !(voxel > 0.0)) {
        throw UsageError("max_error", numberText(scene.maxError->value) + "vx is in voxels, and no collider has any",
                         "give it in world units");
    }
    return scene.maxError->world(voxel);
}

} // namespace

std::optional<AccuracyPlan> planAccuracy(const Scene& scene)
{
    if (!scene.maxError) return std::nullopt;
    const std::vector<Measured> all = measureAll(scene);
    AccuracyPlan plan;
    for (const Measured& one : all)
        plan.voxel = plan.voxel > 0.0 ? std::min(plan.voxel, one.errors.voxel) : one.errors.voxel;
    const double asked = askedOf(scene, plan.voxel);
    if (all.empty()) return plan;
    std::vector<FieldOptions> choices = choicesByCost();
    // Those that fit come first, in the order that they have.
    std::stable_partition(choices.begin(), choices.end(), [&](const FieldOptions& c) { return fits(all, c); });
    double reachable = std::numeric_limits<double>::infinity();
    for (const FieldOptions& choice : choices) {
        plan.error = errorOf(all, choice);
        plan.chosen = choice;
        plan.measured = plan.error <= asked ? measuredError(scene, choice) : plan.error;
        if (plan.error <= asked && plan.measured <= asked) return plan;
        reachable = std::min(reachable, std::max(plan.error, plan.measured));
    }
    throwUnreachable(all, asked, reachable, plan.voxel);
}

Scene withAccuracy(const Scene& scene, const AccuracyPlan& plan)
{
    Scene planned = scene;
    planned.accuracy = plan.chosen;
    planned.maxError.reset();
    return planned;
}

} // namespace vdbounce
