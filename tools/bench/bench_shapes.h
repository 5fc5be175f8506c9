// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/bench_case.h"
#include "bench/make_bench_options.h"

#include "vdbounce/base/progress.h"

namespace vdbounce::bench {

/// Measures sampleField() of a sphere of 1000 voxels' radius and one of 100, band 3, against OpenVDB's levelSetSphere,
/// and of a box against its levelSetCube (made by way of a mesh); taken in turn, medians. Both return a finished grid
/// and neither pays for freeing it. Beside the times the largest error, in voxels, of all active voxels.
Cases benchShapes(const MakeBenchOptions& options, Progress& progress);

} // namespace vdbounce::bench
