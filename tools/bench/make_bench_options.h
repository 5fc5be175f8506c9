// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vdbounce::bench {

/// How the ways to make a level set other than of a mesh are measured.
struct MakeBenchOptions {
    int repetitions = 3; ///< of which the median is taken
};

} // namespace vdbounce::bench
