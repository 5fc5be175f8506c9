// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/bench_case.h"
#include "bench/make_bench_options.h"

#include "vdbounce/base/progress.h"

namespace vdbounce::bench {

/// Measures blobs() on a million particles of one to five voxels, evenly spread and in clusters, with one thread and
/// with all that are allowed: spheres against OpenVDB's ParticlesToLevelSet (bench/blob_peers.h), taken in turn, and
/// their errors against the least distance to all spheres in double precision; Gaussian and compact kernels, which have
/// no peer, alone.
Cases benchBlobs(const MakeBenchOptions& options, Progress& progress);

} // namespace vdbounce::bench
