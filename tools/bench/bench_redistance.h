// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/bench_case.h"
#include "bench/make_bench_options.h"

#include "vdbounce/base/progress.h"

namespace vdbounce::bench {

/// Measures redistance() against OpenVDB's sdfToSdf (fast sweeping) and levelSetRebuild (through a mesh), taken in
/// turn: a sphere, a torus and Zalesak's disc, at several resolutions from exact distances and at one from distorted
/// ones, band 3. All get a level set in memory and return one; none pays for freeing it. Times are wall time on as many
/// threads as are allowed.
///
/// Errors are against the exact distance in double, over all active voxels of each result, in voxels; of the disc also
/// those farther than 4 voxels from its edges. The order is the power of the voxel with which the mean error in
/// world units falls from the coarsest to the finest.
Cases benchRedistance(const MakeBenchOptions& options, Progress& progress);

} // namespace vdbounce::bench
