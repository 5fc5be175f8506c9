// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace vdbounce {

/// Through this the library tells how far long work has come, and learns that it should stop.
/// The library itself never prints. The default does nothing and never stops.
class Progress {
public:
    virtual ~Progress() = default;

    /// `done` of `total` units of the work are finished. Called from one thread at a time.
    virtual void update(std::uint64_t /*done*/, std::uint64_t /*total*/) {}

    /// True once the work should be dropped; may be called from any thread. Long work then throws Interrupted.
    virtual bool stopRequested() const { return false; }

    /// A progress that ignores everything, for callers that do not care.
    static Progress& none();
};

/// Throws Interrupted when `progress` asks to stop.
void throwIfStopped(const Progress& progress);

} // namespace vdbounce
