// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verb.h"

#include "vdbounce/scene/run.h"

#include <chrono>
#include <string>

namespace vdbounce::tool {

/// A line on stderr that shows how far long work is, how fast it goes and how long it will take. Only on a terminal,
/// and not with
/// --quiet; in a pipe there is nothing of it. Also carries Ctrl-C to the library.
class ProgressBar : public RunProgress {
public:
    ProgressBar(const CommonOptions& common, std::string what);
    ~ProgressBar() override;
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// For a run of several frames: `steps` a frame, starting after frame `first`.
    void expectFrames(int first, int last, int steps);

    void update(std::uint64_t done, std::uint64_t total) override;
    void frameDone(int frame, int frames, std::uint64_t particleSteps) override;
    bool stopRequested() const override;

private:
    void draw(double share, double rate);

    const std::string what_;
    const bool visible_;
    const std::chrono::steady_clock::time_point begin_;
    std::chrono::steady_clock::time_point drawn_;
    int firstFrame_ = 0;
    int lastFrame_ = 0;
    int frame_ = 0;
    int stepsPerFrame_ = 1;
    double stepsDone_ = 0.0;
};

} // namespace vdbounce::tool
