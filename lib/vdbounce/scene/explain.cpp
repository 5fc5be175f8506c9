// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/scene/explain.h"

#include "vdbounce/contact/step_needs.h"
#include "vdbounce/io/file_bytes.h"
#include "vdbounce/io/number_text.h"
#include "vdbounce/io/particle_file.h"
#include "vdbounce/scene/describe_collider.h"
#include "vdbounce/scene/run_checks.h"

#include <cmath>
#include <cstdio>

namespace vdbounce {
namespace {

constexpr std::uint64_t kProgramBytes = 45'000'000; // with its libraries

std::string fewDigits(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

std::string describeAccuracy(const FieldOptions& accuracy, const std::optional<AccuracyPlan>& plan)
{
    std::string text = std::string("accuracy: ") + nameOf(accuracy.lookup) + " lookup, " + nameOf(accuracy.normal) +
                       " normals, values kept as " + nameOf(accuracy.storage);
    if (plan)
        text += ", the cheapest within max_error: off by " + fewDigits(plan->error) + " (" +
                fewDigits(plan->error / plan->voxel) + " voxels), on another sample " + fewDigits(plan->measuredVx());
    return text;
}

std::string describeSweep(const Scene& scene, const ColliderSet& colliders)
{
    switch (scene.sweep) {
    case Sweep::Always: return "sweep: along every path that may touch something";
    case Sweep::Never: return "sweep: left out (never); fast particles may pass through thin walls";
    case Sweep::Auto: break;
    }
    if (colliders.size() == 0) return "sweep: none, there is nothing to touch";
    if (!(colliders.wallLength() > 0.0))
        return "sweep: along every path that may touch something (what is cut can be as thin as one likes)";
    return "sweep: only for steps longer than " + numberText(0.5 * colliders.wallLength()) +
           " that may touch something on the way";
}

std::string describeScheme(const Scene& scene)
{
    switch (scene.scheme) {
    case Scheme::Once: return "scheme: once, a response to what penetrates at the end of a step";
    case Scheme::Iterate: return "scheme: iterate, responses until nothing penetrates";
    case Scheme::CollideContact: break;
    }
    return "scheme: collide-contact, up to " + std::to_string(scene.maxBounces) + " bounces a step";
}

std::string describeLookups(const Scene& scene, const ColliderSet& colliders)
{
    std::string text = "lookups: none for a particle whose clearance exceeds its step";
    if (!colliders.still()) text += " and what the colliders move";
    if (scene.repulsionRange.value > 0.0) text += " and the range of repulsion";
    return text + "; gradients only for those that touch" +
           (scene.repulsionRange.value > 0.0 ? " or are in range" : "");
}

std::string describeOmissions(const Scene& scene, const ColliderSet& colliders, const StepNeeds& needs, double radius)
{
    std::string text;
    const auto leaveOut = [&](bool out, const char* what) {
        if (out) text += (text.empty() ? "left out: " : ", ") + std::string(what);
    };
    leaveOut(!needs.motion, "collider velocities (none moves)");
    leaveOut(!needs.several, "asking which collider is nearest (there is one)");
    leaveOut(!needs.friction, "friction (none has any)");
    leaveOut(!needs.taking, "sticking and deleting (none does)");
    leaveOut(!(radius > 0.0), "radii (particles are points)");
    leaveOut(!colliders.anyFree(), "moving colliders by particles (none has a mass)");
    leaveOut(!scene.interact, "particle against particle (not asked for)");
    leaveOut(!needs.repulsion, "repulsion (no range)");
    leaveOut(!needs.hits, "records of hits (not asked for)");
    return text;
}

std::string percent(std::uint64_t part, std::uint64_t whole)
{
    return fewDigits(whole > 0 ? 100.0 * double(part) / double(whole) : 0.0) + " %";
}

std::string describeTrial(const Trial& trial)
{
    const StepTally& tally = trial.tally;
    const std::uint64_t all = tally.free + tally.near;
    return "steps: in a trial of " + std::to_string(trial.particles) + " particles over " +
           std::to_string(trial.steps) + " steps " + percent(tally.free, all) + " were free, " +
           percent(tally.near, all) + " looked something up; " + percent(tally.contacts, all) + " touched, " +
           (tally.swept == 0 ? "none was long enough for a sweep" : percent(tally.swept, all) + " were swept");
}

std::string describeExpectation(const Explanation& plan, bool interact)
{
    const std::string all = std::to_string(plan.particles) + " particles in " + std::to_string(plan.steps) + " steps ";
    const std::string each = fewDigits(plan.trial.nsPerParticleStep) + " ns for a particle and step";
    const std::string memory = ", and " + sizeText(double(plan.bytes));
    if (plan.seconds)
        return "expected: " + each + "; " + all + "take about " + fewDigits(*plan.seconds) +
               " s, reading and writing apart" + memory;
    return "expected: more than " + each + ", as " +
           (interact ? "particles see each other" : "particles move colliders") + "; " + all +
           "take longer than so few can tell" + memory;
}

// Of a particle, bytes: arrays with an entry for each.
std::uint64_t bytesOfOne(const Particles& particles, const Scene& scene)
{
    constexpr std::uint64_t kOfPass = sizeof(double) + 3; // clearance and flags
    return 2 * sizeof(Vec3d) + sizeof(std::int64_t) + kOfPass + (particles.radius.empty() ? 0 : sizeof(double)) +
           (particles.mass.empty() ? 0 : sizeof(double)) + (scene.hits ? sizeof(HitRecord) : 0);
}

// And as long as a file is written, measured with a million and four.
std::uint64_t bytesWhileWritten(const std::string& file)
{
    if (file.empty()) return 0;
    return fileEnding(file) == "csv" ? 95 : 57;
}

struct FrameRange {
    int first;
    int count;
};

// What steps and memory it takes.
void expect(const Scene& scene, SceneColliders& loader, const Particles& particles, const ParticleDefaults& defaults,
            const FrameRange& frames, Progress& progress, Explanation& plan)
{
    constexpr double kWhileBuilt = 1.4; // a field and the grid that it is built from
    plan.particles = particles.size();
    plan.steps = std::uint64_t(frames.count) * std::uint64_t(scene.stepsPerFrame);
    plan.bytes = std::uint64_t(kWhileBuilt * double(loader.memoryBytes())) + kProgramBytes +
                 plan.particles * (bytesOfOne(particles, scene) + bytesWhileWritten(scene.outputFile));
    const bool freeBodies = loader.onTheWayTo(frames.first).anyFree();
    plan.trial = tryOut(scene, loader, particles, defaults, frames.first, frames.count, progress);
    if (!scene.interact && !freeBodies)
        plan.seconds = plan.trial.nsPerParticleStep * 1e-9 * double(plan.particles) * double(plan.steps);
}

} // namespace

Explanation explainScene(const Scene& asked, const RunOptions& options, Progress& progress)
{
    requireRunnable(asked, options);
    Explanation plan;
    plan.accuracy = planAccuracy(asked);
    const Scene scene = plan.accuracy ? withAccuracy(asked, *plan.accuracy) : asked;
    SceneColliders loader(scene);
    const ColliderSet colliders = loader.onTheWayTo(options.firstFrame);
    const ParticleDefaults defaults = particleDefaults(scene, colliders);
    const Particles particles = readParticles(startFile(scene, options.firstFrame));
    loader.requireBandsForRadius(colliders, particles, defaults);
    const StepOptions steps = stepOptions(scene, colliders);
    const ContactReach reach = contactReach(particles, defaults, steps);
    const int frames = lastFrameOf(scene, options) - options.firstFrame;

    std::vector<std::string>& lines = plan.lines;
    lines.push_back("time: " + std::to_string(frames) + " frames of " + std::to_string(scene.stepsPerFrame) +
                    " steps of " + numberText(scene.dt) + " s");
    lines.push_back("particles: " + std::to_string(particles.size()) + " of " + scene.particleFile + ", radius " +
                    numberText(defaults.radius) + " and mass " + numberText(defaults.mass) + " where it carries none");
    const std::vector<const ColliderSpec*> specs = collidersMet(scene);
    for (std::size_t i = 0; i < colliders.size(); ++i)
        lines.push_back(describeCollider(*specs[i], colliders[i], reach));
    if (std::isfinite(colliders.smallestVoxel())) lines.push_back(describeAccuracy(scene.accuracy, plan.accuracy));
    lines.push_back(describeScheme(scene));
    lines.push_back(describeSweep(scene, colliders));
    lines.push_back(describeLookups(scene, colliders));
    const std::string omissions =
        describeOmissions(scene, colliders, needsOf(colliders, steps, scene.hits), reach.radius);
    if (!omissions.empty()) lines.push_back(omissions);
    expect(scene, loader, particles, defaults, {options.firstFrame, frames}, progress, plan);
    lines.push_back(describeTrial(plan.trial));
    lines.push_back(describeExpectation(plan, scene.interact));
    return plan;
}

} // namespace vdbounce
