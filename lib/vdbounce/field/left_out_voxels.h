// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/io/level_set_grid.h"

#include <cstdint>

namespace vdbounce {

/// What a level set cannot tell of the surface, because it has no more voxels.
struct Resolution {
    /// 99 of 100 lookups by splines near the surface are off by no more; world units. 0 where there is no surface,
    /// infinite where the voxels do not tell: their band is too thin, or there are too few of them.
    double error = 0.0;
    /// The power of the voxel's size with which that shrinks: 1 along edges, 2 where the surface is smooth.
    double order = 1.0;
};

/// Estimates that from the voxels alone, by leaving them out: each within a voxel of the surface, in a sample of the
/// leaves that `seed` chooses, is predicted from others along the axes, once by splines through those two voxels apart,
/// and linearly from those two and four voxels apart, which tells the order. Needs a band of two voxels and more on
/// both sides, and some hundred voxels. Bodies of a few voxels, and values that are no distances to begin with, are
/// told too well. Same result for any number of threads.
Resolution estimateResolution(const LevelSetGrid& grid, std::uint64_t seed);

} // namespace vdbounce
