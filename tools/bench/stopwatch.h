// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
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
