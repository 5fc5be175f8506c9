// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/vector_lookup.h"

namespace vdbounce::bench {

/// How the voxels of one leaf's cells lie in memory: 9^3, z fastest, each with its phi and gradient in four floats.
struct PrecomputedLayout {
    static constexpr int kSide = BlockLayout::kLeafSide + 1;
    static constexpr int kVoxel = 4;
    static constexpr int kStrideY = kSide * kVoxel;
    static constexpr int kStrideX = kSide * kStrideY;
    static constexpr int kSize = kSide * kStrideX;
};

/// The trilinear interpolation of all four at the chunk's first `count` points, all of which must be in blocks, with
/// the vector code of this processor. `samples` needs room for the next multiple of 4.
void interpolatePrecomputed(const float* voxels, const PointChunk& chunk, int count, PointSample* samples);

} // namespace vdbounce::bench
