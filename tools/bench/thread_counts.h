// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tbb/global_control.h>

namespace vdbounce::bench {

/// Calls body("1 thread") with one thread and, where more are allowed, body("N threads") with all of them.
template <class Body> void onOneAndAllThreads(const Body& body)
{
    const auto all = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        body(std::string("1 thread"));
    }
    if (all > 1) body(std::to_string(all) + " threads");
}

} // namespace vdbounce::bench
