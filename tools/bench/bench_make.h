// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/bench_case.h"
#include "bench/make_bench_options.h"

#include "vdbounce/base/progress.h"

namespace vdbounce::bench {

/// All ways to a level set that need no mesh: shapes, CSG, blobs and redistancing.
Cases benchMake(const MakeBenchOptions& options, Progress& progress);

} // namespace vdbounce::bench
