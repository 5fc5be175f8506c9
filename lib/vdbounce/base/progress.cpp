// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/base/progress.h"

#include "vdbounce/base/error.h"

namespace vdbounce {

Progress& Progress::none()
{
    static Progress instance;
    return instance;
}

void ProgressCounter::add(std::uint64_t count)
{
    const std::uint64_t done = done_ += count;
    const std::unique_lock<std::mutex> lock(telling_, std::try_to_lock);
    if (lock.owns_lock()) progress_.update(done, total_);
    throwIfStopped(progress_);
}

void throwIfStopped(const Progress& progress)
{
    if (progress.stopRequested()) throw Interrupted();
}

} // namespace vdbounce
