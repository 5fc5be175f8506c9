// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/scene/run_checks.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/particle_file.h"

#include <algorithm>
#include <filesystem>
#include <set>

namespace vdbounce {
namespace {

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

} // namespace

int lastFrameOf(const Scene& scene, const RunOptions& options)
{
    return options.lastFrame < 0 ? scene.frames : options.lastFrame;
}

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

void requireRunnable(const Scene& scene, const RunOptions& options)
{
    validate(scene);
    if (!scene.outputFile.empty()) requireParticleFile(scene.outputFile);
    const int lastFrame = lastFrameOf(scene, options);
    if (options.firstFrame < 0 || options.firstFrame > lastFrame) {
        throw UsageError("--frames " + std::to_string(options.firstFrame) + "-" + std::to_string(lastFrame),
                         "is no range of frames", "give FIRST-LAST with FIRST not above LAST");
    }
    requireInputsKept(scene, options.firstFrame, lastFrame);
    requireSequences(scene, options.firstFrame, lastFrame);
}

} // namespace vdbounce
