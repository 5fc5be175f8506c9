// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/implicit/ball_list.h"
#include "vdbounce/implicit/blob_kernel.h"
#include "vdbounce/io/scalar_grid.h"

#include <cstdint>
#include <optional>

namespace vdbounce {

/// Where the surface of a sum of kernels is.
struct BlobSurface {
    BlobKernel kernel; ///< Gaussian or Compact
    double level;      ///< the sum at the surface, t / alpha, > 0
    double least;      ///< what a ball adds to the sum counts where it is at least this; > 0, below `level`

    /// A ball matters up to this multiple of its radius.
    double reachPerRadius() const { return kernelArgument(kernel, least); }
};

/// An implicit function of the sum's surface, negative inside: near it, world units and close to distance (exactly the
/// distance to a ball alone, times the mean radius over its own). `balls` are in index space. Nothing where no two
/// voxels lie on different sides.
///
/// Active leaves hold all voxels up to two from a change of sign; elsewhere inactive tiles and the background tell the
/// side alone. No sum is evaluated where bounds on it tell the sign of a leaf and of its neighbours. The same bits for
/// any number of threads. Throws UsageError for more than `maxLeaves` leaves near it, Interrupted.
std::optional<ScalarGrid> blobImplicit(BallList balls, const BlobSurface& surface, double voxelSize,
                                       std::uint64_t maxLeaves, Progress& progress);

} // namespace vdbounce
