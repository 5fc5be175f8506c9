// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace vdbounce::tool {

/// Seconds of one stretch of work after the other.
class Stopwatch {
public:
    /// Since the last lap, or the beginning.
    double lap()
    {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - mark_).count();
        mark_ = now;
        return seconds;
    }

private:
    std::chrono::steady_clock::time_point mark_ = std::chrono::steady_clock::now();
};

} // namespace vdbounce::tool
