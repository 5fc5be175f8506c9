// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/bench_case.h"
#include "bench/make_bench_options.h"

#include "vdbounce/base/progress.h"

namespace vdbounce::bench {

/// Measures csg() on grids against OpenVDB's csgUnionCopy, csgIntersectionCopy and csgDifferenceCopy, and its csgUnion
/// after the copies of both operands that it consumes: spheres of radius 100, 200 and 400 voxels whose centres are a
/// radius apart, and two of 200 that are far apart; band 3. Operands lie in memory, results are not freed on the clock.
/// On one thread and on as many as are allowed. Throws RunError where any voxel's value differs.
Cases benchCsg(const MakeBenchOptions& options, Progress& progress);

} // namespace vdbounce::bench
