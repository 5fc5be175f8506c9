// SPDX-License-Identifier: Apache-2.0
#include "bench/trade_scene.h"

#include "bench/scene_trial.h"
#include "bench/stopwatch.h"

#include "vdbounce/base/error.h"
#include "vdbounce/scene/accuracy_plan.h"
#include "vdbounce/scene/run.h"
#include "vdbounce/scene/scene_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace vdbounce::bench {
namespace {

constexpr int kFinestSteps = 8; // in place of one

// As it is run here: nothing is written, and no particle is lost.
Scene comparableScene(const std::string& file)
{
    Scene scene = readScene(file);
    if (const auto plan = planAccuracy(scene)) scene = withAccuracy(scene, *plan);
    scene.outputFile.clear();
    if (scene.frames == 0) throw UsageError(file, "time.frames is 0, so there is nothing to run", "give 1 or more");
    for (ColliderSpec& collider : scene.colliders) {
        if (collider.onHit != OnHit::Delete) continue;
        if (collider.body) {
            throw UsageError(file,
                             "collider '" + collider.name + "' has a mass and deletes, so runs cannot be compared",
                             "give it on_hit = \"bounce\"");
        }
        collider.onHit = OnHit::Stick;
    }
    return scene;
}

// The same time in frames of `steps` steps.
Scene withSteps(const Scene& scene, int steps)
{
    Scene other = scene;
    other.dt = scene.dt * (double(scene.stepsPerFrame) / steps);
    other.stepsPerFrame = steps;
    return other;
}

Scene finestOf(const Scene& scene)
{
    Scene finest = withSteps(scene, kFinestSteps * scene.stepsPerFrame);
    finest.accuracy = {Lookup::Cubic, Normal::Analytic, Storage::Float};
    finest.scheme = Scheme::CollideContact;
    finest.sweep = Sweep::Always;
    return finest;
}

// All ways to look up with the scene's own way to step, its own settings among them.
std::vector<Scene> everyLookup(const Scene& scene)
{
    std::vector<Scene> all;
    for (const Lookup lookup : {Lookup::Nearest, Lookup::Trilinear, Lookup::Cubic}) {
        for (const Normal normal : {Normal::Central, Normal::Analytic}) {
            for (const Storage storage : {Storage::Float, Storage::Half, Storage::Fixed8}) {
                all.push_back(scene);
                all.back().accuracy = {lookup, normal, storage};
            }
        }
    }
    return all;
}

// All ways to step but the scene's own.
std::vector<Scene> otherSteps(const Scene& scene)
{
    const int own = scene.stepsPerFrame;
    std::vector<int> steps = {own, 2 * own, 4 * own};
    if (own > 1) steps.insert(steps.begin(), (own + 1) / 2);
    std::vector<Scene> all;
    for (const Scheme scheme : {Scheme::Once, Scheme::Iterate, Scheme::CollideContact}) {
        for (const Sweep sweep : {Sweep::Never, Sweep::Auto, Sweep::Always}) {
            for (const int inAFrame : steps) {
                if (scheme == scene.scheme && sweep == scene.sweep && inAFrame == own) continue;
                all.push_back(withSteps(scene, inAFrame));
                all.back().scheme = scheme;
                all.back().sweep = sweep;
            }
        }
    }
    return all;
}

struct Spread {
    double sum = 0.0;
    double largest = 0.0;
    std::size_t count = 0;

    void add(double value)
    {
        sum += value;
        largest = std::max(largest, value);
        ++count;
    }
    double mean() const { return count == 0 ? 0.0 : sum / double(count); }
};

// `voxel` is infinite where there is none.
std::vector<std::pair<std::string, double>> errorsOf(const SceneOutcome& run, const SceneOutcome& finest, double voxel)
{
    const bool hasVoxels = std::isfinite(voxel);
    const double unit = hasVoxels ? voxel : 1.0;
    const std::string suffix = hasVoxels ? "_vx" : "";
    const double kinetic = finest.mostKinetic;
    Spread place;
    Spread time;
    Spread end;
    Spread missed;
    for (std::size_t i = 0; i < run.particles.size(); ++i) {
        if (!run.particles.rejected.empty() && run.particles.rejected[i] != 0) continue;
        const HitRecord& hit = run.firstHit[i];
        const HitRecord& truth = finest.firstHit[i];
        end.add((run.particles.position[i] - finest.particles.position[i]).norm() / unit);
        missed.add((hit.count == 0) == (truth.count == 0) ? 0.0 : 1.0);
        if (hit.count == 0 || truth.count == 0) continue;
        place.add((hit.position - truth.position).norm() / unit);
        time.add(std::abs(hit.time - truth.time));
    }
    return {{"place_of_impact" + suffix, place.mean()},
            {"place_of_impact_max" + suffix, place.largest},
            {"time_of_impact_s", time.mean()},
            {"time_of_impact_max_s", time.largest},
            {"missed", missed.mean()},
            {"penetration" + suffix, run.deepest / unit},
            {"energy_drift", kinetic > 0.0 ? std::abs(run.energy - finest.energy) / kinetic : 0.0},
            {"final_position" + suffix, end.mean()}};
}

TradeCase measure(const Scene& scene, const SceneStart& start, const SceneOutcome& finest, double voxel,
                  int repetitions, Progress& progress)
{
    TradeCase one;
    one.settings = {std::isfinite(voxel) ? voxel : 0.0, scene.accuracy, scene.scheme, scene.sweep, scene.dt};
    std::optional<SceneColliders> colliders;
    one.cost.buildSeconds.push_back(seconds([&] {
        colliders.emplace(scene);
        colliders->onTheWayTo(0);
    }));
    one.addErrors(errorsOf(outcomeOf(scene, *colliders, start, progress), finest, voxel));
    one.cost.bytes = colliders->memoryBytes();
    for (int r = 0; r < repetitions; ++r)
        one.cost.nsPerParticleStep.push_back(timeOf(scene, *colliders, start, progress));
    return one;
}

// Without any there is nothing to measure.
void requireHits(const SceneOutcome& outcome, const std::string& file, int frames, int all)
{
    const auto& hits = outcome.firstHit;
    if (std::any_of(hits.begin(), hits.end(), [](const HitRecord& hit) { return hit.count > 0; })) return;
    throw UsageError(file,
                     "none of " + std::to_string(hits.size()) + " particles hits anything in its first " +
                         std::to_string(frames) + " of " + std::to_string(all) + " frames",
                     frames < all ? "run more with --frames" : "give it particles that do, or more frames");
}

} // namespace

std::vector<TradeCase> tradeScene(const std::string& file, const TradeOptions& options, Progress& progress)
{
    const Scene scene = comparableScene(file);
    RunProgress quiet;
    runScene(scene, {0, 0}, quiet); // refuses what collide would
    const Scene finestScene = finestOf(scene);
    SceneColliders finestColliders(finestScene);
    const ColliderSet colliders = finestColliders.onTheWayTo(0);
    const SceneStart start = startOf(scene, colliders, options.shots, options.frames);
    const SceneOutcome finest = outcomeOf(finestScene, finestColliders, start, progress);
    requireHits(finest, file, start.frames, scene.frames);
    const double voxel = colliders.smallestVoxel();
    std::vector<Scene> choices = std::isfinite(voxel) ? everyLookup(scene) : std::vector<Scene>{scene};
    const std::vector<Scene> steps = otherSteps(scene);
    choices.insert(choices.end(), steps.begin(), steps.end());
    std::vector<TradeCase> cases;
    for (const Scene& choice : choices) {
        cases.push_back(measure(choice, start, finest, voxel, options.repetitions, progress));
        cases.back().group = std::filesystem::path(file).filename().string() + ", steps";
    }
    return cases;
}

} // namespace vdbounce::bench
