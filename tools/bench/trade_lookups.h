// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/trade_case.h"
#include "bench/trade_subject.h"

#include <cstddef>

namespace vdbounce::bench {

struct TradeOptions {
    std::size_t points = 100'000; ///< looked up, within a voxel of the surface
    std::size_t shots = 2000;     ///< particles of each way to step
    int frames = 0;               ///< of a scene, at most; 0: those of its first second
    int repetitions = 3;
};

/// Every voxel size, lookup, normal and storage: phi and gradient of the same points near the surface, in random order,
/// others in each repetition. Beside them, with the usual lookup and storage, gradients that are stored instead of
/// computed (PrecomputedGradients). Errors: of phi the mean, that of 99 % and the largest, in world units and in
/// voxels; of the normal's angle the mean and the largest, where the true one is known. On one thread.
std::vector<TradeCase> tradeLookups(const TradeSubject& subject, const TradeOptions& options, Progress& progress);

} // namespace vdbounce::bench
