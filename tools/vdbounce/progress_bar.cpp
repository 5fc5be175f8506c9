// SPDX-License-Identifier: Apache-2.0
#include "progress_bar.h"

#include "signals.h"

#include <algorithm>
#include <cstdio>

#include <unistd.h>

namespace vdbounce::tool {
namespace {

constexpr int kBarWidth = 28;
constexpr std::chrono::milliseconds kRedraw{100};
constexpr const char* kEraseLine = "\r\033[K";

std::string clockText(double seconds)
{
    const auto whole = static_cast<long>(std::min(seconds, 359999.0));
    char text[32];
    if (whole >= 3600) {
        std::snprintf(text, sizeof(text), "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
    } else {
        std::snprintf(text, sizeof(text), "%ld:%02ld", whole / 60, whole % 60);
    }
    return text;
}

std::string rateText(double perSecond)
{
    char text[48];
    std::snprintf(text, sizeof(text), "%.1f M particle steps/s", perSecond * 1e-6);
    return text;
}

} // namespace

ProgressBar::ProgressBar(const CommonOptions& common, std::string what)
    : what_(std::move(what)), visible_(!common.quiet && ::isatty(STDERR_FILENO) == 1),
      begin_(std::chrono::steady_clock::now())
{
}

ProgressBar::~ProgressBar()
{
    if (visible_) std::fputs(kEraseLine, stderr);
}

void ProgressBar::expectFrames(int first, int last, int steps)
{
    firstFrame_ = frame_ = first;
    lastFrame_ = last;
    stepsPerFrame_ = steps;
}

bool ProgressBar::stopRequested() const { return interruptRequested(); }

void ProgressBar::frameDone(int frame, int frames, std::uint64_t particleSteps)
{
    frame_ = frame;
    stepsDone_ = double(particleSteps);
    update(0, frames > 0 ? 1 : 0);
}

void ProgressBar::update(std::uint64_t done, std::uint64_t total)
{
    const auto now = std::chrono::steady_clock::now();
    if (!visible_ || now - drawn_ < kRedraw) return;
    drawn_ = now;
    const double within = total > 0 ? double(done) / double(total) : 0.0;
    const int frames = lastFrame_ - firstFrame_;
    const double share = frames > 0 ? (double(frame_ - firstFrame_) + within) / frames : within;
    const double seconds = std::chrono::duration<double>(now - begin_).count();
    draw(std::clamp(share, 0.0, 1.0),
         frames > 0 ? (stepsDone_ + double(done) * stepsPerFrame_) / std::max(seconds, 1e-9) : 0.0);
}

void ProgressBar::draw(double share, double rate)
{
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    std::string line = kEraseLine + what_;
    if (lastFrame_ > 0)
        line += " frame " + std::to_string(std::min(frame_ + 1, lastFrame_)) + "/" + std::to_string(lastFrame_);
    line += " [";
    const int filled = static_cast<int>(share * kBarWidth);
    line += std::string(std::size_t(filled), '=') + std::string(std::size_t(kBarWidth - filled), ' ') + "]";
    if (rate > 0.0) line += " " + rateText(rate);
    if (share > 0.0) line += ", " + clockText(seconds * (1.0 - share) / share) + " left";
    std::fputs(line.c_str(), stderr);
    std::fflush(stderr);
}

} // namespace vdbounce::tool
