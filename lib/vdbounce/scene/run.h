// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/contact/step.h"
#include "vdbounce/scene/scene.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vdbounce {

struct RunOptions {
    int firstFrame = 0; ///< the state to start from: 0 is the particle file, else that frame of an earlier run's output
    int lastFrame = -1; ///< below 0: scene.frames
    bool strict = false; ///< particles that cannot be stepped end the run with an InputError
};

/// A Progress that is also told of frames.
class RunProgress : public Progress {
public:
    /// `frame` of `frames` is done, after `particleSteps` in all.
    virtual void frameDone(int /*frame*/, int /*frames*/, std::uint64_t /*particleSteps*/) {}
};

/// What the scene's maxError led to.
struct RunAccuracy {
    FieldOptions chosen;
    double measuredErrorVx = 0.0; ///< on another sample than the one that it was chosen by; of the finest level set
};

struct RunReport {
    std::uint64_t particles = 0;
    int frames = 0; ///< advanced
    std::uint64_t steps = 0;
    double seconds = 0.0; ///< of stepping, reading and writing apart
    StepTally tally;
    std::uint64_t rejected = 0;
    std::uint64_t deleted = 0;
    double energyInitial = 0.0;
    double energyFinal = 0.0;
    std::vector<std::string> colliderNames; ///< in the order of tally.impulse
    std::vector<std::string> files;         ///< written
    std::optional<RunAccuracy> accuracy;    ///< where the scene has a maxError
    std::uint64_t particleSteps = 0;        ///< taken; fewer than particles times steps where some were deleted

    double particleStepsPerSecond() const { return seconds > 0.0 ? double(particleSteps) / seconds : 0.0; }
};

/// Runs a scene from its particle file to its last frame, writing frames as the scene says. Every file is written whole
/// or not at all, and nothing is written before everything that the scene names has been read, but for the later files
/// of sequences, which are known to exist then.
///
/// Throws ToleranceError where nothing reaches the scene's maxError, InputError for files that cannot be used and for
/// radii that a collider's narrow band cannot answer (naming the band that would do), UsageError for options out of
/// range, Interrupted.
RunReport runScene(const Scene& scene, const RunOptions& options, RunProgress& progress);

} // namespace vdbounce
