// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/scene/run.h"

#include "vdbounce/base/error.h"
#include "vdbounce/contact/particle_pass.h"
#include "vdbounce/io/particle_file.h"
#include "vdbounce/scene/accuracy_plan.h"
#include "vdbounce/scene/scene_colliders.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <set>

namespace vdbounce {
namespace {

std::string startFile(const Scene& scene, int firstFrame)
{
    if (firstFrame == 0) return scene.particleFile;
    if (!hasFramePattern(scene.outputFile)) {
        throw UsageError("--frames " + std::to_string(firstFrame) + "-", "the output has no #### to find that frame by",
                         "start at frame 0");
    }
    return framePath(scene.outputFile, firstFrame);
}

bool isWritten(const Scene& scene, int frame, int lastFrame)
{
    if (scene.outputFile.empty()) return false;
    if (frame == lastFrame) return true;
    return hasFramePattern(scene.outputFile) && frame % scene.every == 0;
}

// A frame's file may have the name of a file that the scene reads, which writing would destroy.
void requireInputsKept(const Scene& scene, int firstFrame, int lastFrame)
{
    std::set<std::filesystem::path> inputs;
    const auto add = [&](const std::string& path) {
        std::error_code missing;
        const std::filesystem::path real = std::filesystem::canonical(path, missing);
        if (!missing) inputs.insert(real);
    };
    add(scene.particleFile);
    for (const ColliderSpec& collider : scene.colliders) {
        if (!collider.file.empty()) add(collider.file);
        if (collider.blobs) add(collider.blobs->file);
        if (collider.heightfield) add(collider.heightfield->file);
        for (int frame = 0; !collider.sequence.empty() && frame <= lastFrame; ++frame)
            add(framePath(collider.sequence, frame));
    }
    for (int frame = firstFrame == 0 ? 0 : firstFrame + 1; frame <= lastFrame; ++frame) {
        if (!isWritten(scene, frame, lastFrame)) continue;
        const std::string output = framePath(scene.outputFile, frame);
        std::error_code missing;
        if (inputs.count(std::filesystem::canonical(output, missing)) == 0 || missing) continue;
        throw UsageError(output, "is the input, which writing frame " + std::to_string(frame) + " would destroy",
                         "name another output");
    }
}

// All at once, rather than after hours at the one that is missing.
void requireSequences(const Scene& scene, int firstFrame, int lastFrame)
{
    for (const ColliderSpec& collider : scene.colliders) {
        for (int frame = firstFrame; !collider.sequence.empty() && frame <= lastFrame; ++frame) {
            const std::string path = framePath(collider.sequence, frame);
            if (std::filesystem::exists(path)) continue;
            throw InputError(path, "of the sequence of collider '" + collider.name + "' does not exist",
                             "write it, or end with --frames " + std::to_string(firstFrame) + "-" +
                                 std::to_string(std::max(firstFrame, frame - 1)));
        }
    }
}

void requireSteppable(const PassReport& pass, const Scene& scene)
{
    if (pass.rejected == 0) return;
    throw InputError(scene.particleFile,
                     std::to_string(pass.rejected) + " particles are not finite or have a negative radius or mass",
                     "remove them or run without --strict");
}

class Run {
public:
    Run(const Scene& scene, const RunOptions& options, RunProgress& progress)
        : scene_(scene), options_(options), progress_(progress),
          lastFrame_(options.lastFrame < 0 ? scene.frames : options.lastFrame), loader_(scene),
          colliders_(loader_.onTheWayTo(options.firstFrame)), defaults_(particleDefaults(scene, colliders_)),
          particles_(readParticles(startFile(scene, options.firstFrame)))
    {
        loader_.requireBandsForRadius(colliders_, particles_, defaults_);
        requireRestart();
        requireKnownColliders();
        report_.particles = particles_.size();
        report_.tally = StepTally(colliders_.size());
        report_.energyInitial = totalEnergy(particles_, defaults_, scene_.gravity);
        for (const ColliderSpec* collider : collidersMet(scene_)) report_.colliderNames.push_back(collider->name);
    }

    RunReport run()
    {
        PassOptions options = passOptions(scene_, colliders_, defaults_);
        options.firstStep = std::uint64_t(options_.firstFrame) * std::uint64_t(scene_.stepsPerFrame);
        ParticlePass pass(particles_, colliders_, options);
        if (options_.firstFrame == 0) writeFrame(0);
        for (int frame = options_.firstFrame + 1; frame <= lastFrame_; ++frame) {
            if (loader_.deforming()) {
                colliders_ = loader_.onTheWayTo(frame);
                loader_.requireBandsForRadius(colliders_, particles_, defaults_);
                pass.setColliders(colliders_);
            }
            advance(pass, frame);
            writeFrame(frame);
        }
        report_.energyFinal = totalEnergy(particles_, defaults_, scene_.gravity);
        return report_;
    }

private:
    // Frames hold particles only.
    void requireRestart() const
    {
        if (options_.firstFrame == 0 || !colliders_.anyFree()) return;
        throw UsageError("--frames " + std::to_string(options_.firstFrame) + "-",
                         "a collider has a mass, and where it was then is in no file", "start at frame 0");
    }

    // A particle may have stuck to a collider that the scene has no more.
    void requireKnownColliders() const
    {
        for (std::size_t i = 0; i < particles_.stuckTo.size(); ++i) {
            const std::int32_t collider = particles_.stuckTo[i];
            if (collider >= MovingParticle::kNotStuck && collider < std::int32_t(colliders_.size())) continue;
            throw InputError(startFile(scene_, options_.firstFrame),
                             "particle " + std::to_string(particles_.id[i]) + " is stuck to collider " +
                                 std::to_string(collider) + ", and the scene has " + std::to_string(colliders_.size()),
                             "remove the attribute 'stuck' or use the scene that wrote it");
        }
    }

    void advance(ParticlePass& pass, int frame)
    {
        const auto begin = std::chrono::steady_clock::now();
        const std::uint64_t count = particles_.size();
        const PassReport done = pass.advance(scene_.stepsPerFrame, progress_);
        report_.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        if (options_.strict) requireSteppable(done, scene_);
        report_.tally += done.tally;
        report_.rejected = done.rejected;
        report_.deleted += done.deleted;
        report_.steps += static_cast<std::uint64_t>(scene_.stepsPerFrame);
        report_.particleSteps += count * static_cast<std::uint64_t>(scene_.stepsPerFrame);
        ++report_.frames;
        progress_.frameDone(frame, lastFrame_, report_.particleSteps);
    }

    void writeFrame(int frame)
    {
        throwIfStopped(progress_);
        if (!isWritten(scene_, frame, lastFrame_)) return;
        const std::string path = framePath(scene_.outputFile, frame);
        writeParticles(particles_, path);
        report_.files.push_back(path);
    }

    const Scene& scene_;
    const RunOptions& options_;
    RunProgress& progress_;
    const int lastFrame_;
    SceneColliders loader_;
    ColliderSet colliders_;
    const ParticleDefaults defaults_;
    Particles particles_;
    RunReport report_;
};

} // namespace

RunReport runScene(const Scene& scene, const RunOptions& options, RunProgress& progress)
{
    validate(scene);
    if (!scene.outputFile.empty()) requireParticleFile(scene.outputFile);
    const int lastFrame = options.lastFrame < 0 ? scene.frames : options.lastFrame;
    if (options.firstFrame < 0 || options.firstFrame > lastFrame) {
        throw UsageError("--frames " + std::to_string(options.firstFrame) + "-" + std::to_string(lastFrame),
                         "is no range of frames", "give FIRST-LAST with FIRST not above LAST");
    }
    requireInputsKept(scene, options.firstFrame, lastFrame);
    requireSequences(scene, options.firstFrame, lastFrame);
    const std::optional<AccuracyPlan> plan = planAccuracy(scene, options.firstFrame);
    if (!plan) return Run(scene, options, progress).run();
    Scene planned = scene;
    planned.accuracy = plan->chosen;
    // Before hours of work rather than after them: it needs the files.
    const double error = measuredError(planned, options.firstFrame);
    RunReport report = Run(planned, options, progress).run();
    report.accuracy = RunAccuracy{plan->chosen, plan->voxel > 0.0 ? error / plan->voxel : 0.0};
    return report;
}

} // namespace vdbounce
