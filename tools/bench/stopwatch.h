// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <time.h>
#include <vector>

namespace vdbounce::bench {

inline double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

template <class Work> double seconds(const Work& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Processor time that all threads of this process have taken so far: two threads that work for a second take two.
inline double processorSeconds()
{
    timespec time{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

template <class Work> double nanosecondsAPoint(std::size_t count, const Work& work)
{
    return seconds(work) * 1e9 / double(count);
}

template <class Work> double medianSeconds(int repetitions, const Work& work)
{
    std::vector<double> times;
    for (int r = 0; r < repetitions; ++r) times.push_back(seconds(work));
    return median(times);
}

} // namespace vdbounce::bench
