// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>

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

/// Counts finished units from any number of threads and tells a Progress, from whichever thread finds nobody else
/// telling.
class ProgressCounter {
public:
    ProgressCounter(Progress& progress, std::uint64_t total) : progress_(progress), total_(total) {}

    /// Throws Interrupted when the work should stop.
    void add(std::uint64_t count);

private:
    Progress& progress_;
    const std::uint64_t total_;
    std::atomic<std::uint64_t> done_{0};
    std::mutex telling_;
};

/// Throws Interrupted when `progress` asks to stop.
void throwIfStopped(const Progress& progress);

} // namespace vdbounce
