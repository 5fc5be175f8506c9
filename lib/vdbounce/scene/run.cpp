// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/scene/run.h"

#include "vdbounce/base/error.h"
#include "vdbounce/contact/particle_pass.h"
#include "vdbounce/io/particle_file.h"
#include "vdbounce/scene/accuracy_plan.h"
#include "vdbounce/scene/run_checks.h"
#include "vdbounce/scene/scene_colliders.h"

#include <algorithm>
#include <chrono>

namespace vdbounce {
namespace {

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
        : scene_(scene), options_(options), progress_(progress), lastFrame_(lastFrameOf(scene, options)),
          loader_(scene), colliders_(loader_.onTheWayTo(options.firstFrame)),
          defaults_(particleDefaults(scene, colliders_)),
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
    requireRunnable(scene, options);
    const std::optional<AccuracyPlan> plan = planAccuracy(scene);
    if (!plan) return Run(scene, options, progress).run();
    const Scene planned = withAccuracy(scene, *plan);
    RunReport report = Run(planned, options, progress).run();
    report.accuracy = RunAccuracy{plan->chosen, plan->measuredVx()};
    return report;
}

} // namespace vdbounce
