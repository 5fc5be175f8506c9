// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"
#include "vdbounce/implicit/ball_list.h"
#include "vdbounce/implicit/blob_kernel.h"

#include <cstddef>

namespace vdbounce {

/// What is summed: the kernel's values that are at least `least`, others count for nothing. Gaussian or Compact.
struct KernelSum {
    BlobKernel kernel;
    float least; ///< above 0
};

/// The sum of all balls' kernels (index space) at the 8^3 voxels of a leaf (leaf coordinates), z fastest. Single
/// precision relative to the leaf, in the order of the balls; the same bits on every processor.
void sumKernelsInLeaf(const Ball* balls, std::size_t count, const Vec3i& leaf, const KernelSum& sum, float* values);

/// Between these lies the sum at every point of a box (index space).
struct SumBounds {
    float low = 0.0f;
    float high = 0.0f;
};
SumBounds boundKernels(const Ball* balls, std::size_t count, const Box& box, const KernelSum& sum);

/// True where it is certain that the sum is above `level` everywhere in a box (index space): the box is cut into 8^3
/// cells, to each of which a ball adds no less than at the cell's far corner. Looks at no more balls than it takes.
bool isCovered(const Ball* balls, std::size_t count, const Box& box, const KernelSum& sum, float level);

/// Makes sums into something like distances, 512 values in place: each becomes the argument x at which one kernel alone
/// has that value, so that a particle alone gives its exact distance over its radius. Where the sum is larger than the
/// kernel at `innermost` (above 0), the curve goes on straight: in the logarithm of the sum for Gaussian, in its cube
/// root for Compact. Falls where sums rise.
void sumsToArguments(BlobKernel kernel, float innermost, float* values);

} // namespace vdbounce
