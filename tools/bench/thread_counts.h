// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tbb/global_control.h>

namespace vdbounce::bench {

/// How many threads this run may use, for the name of a case: "1 thread", "16 threads".
inline std::string threadsText()
{
    const auto count = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return std::to_string(count) + (count == 1 ? " thread" : " threads");
}

/// Calls body("1 thread") with one thread and, where more are allowed, body("N threads") with all of them.
template <class Body> void onOneAndAllThreads(const Body& body)
{
    const auto all = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        body(threadsText());
    }
    if (all > 1) body(threadsText());
}

} // namespace vdbounce::bench
