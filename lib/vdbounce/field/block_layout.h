// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"

namespace vdbounce {

/// How the values of one 8^3 leaf lie in memory, of whatever type they are: the leaf's own voxels with a halo of one
/// voxel below and two above, so that the 4^3 values around any cell of the leaf lie in one block, in rows along z.
struct BlockLayout {
    static constexpr int kLeafBits = 3;
    static constexpr int kLeafSide = 1 << kLeafBits;
    static constexpr int kHaloBelow = 1;
    static constexpr int kRows = 11; // kHaloBelow + kLeafSide + 2
    static constexpr int kStrideY = kRows;
    static constexpr int kStrideX = kRows * kRows;
    static constexpr int kSize = kRows * kStrideX;

    /// From a voxel of the leaf to the voxel diagonally after it, and from the first value of a block to the leaf's
    /// first voxel.
    static constexpr int kDiagonal = kStrideX + kStrideY + 1;

    /// Where the 4^3 values around the cell above `voxel` (any voxel in space) begin in the block of its leaf. The
    /// voxel's own value is kDiagonal further.
    static int neighbourhoodOf(const Vec3i& voxel)
    {
        constexpr int kMask = kLeafSide - 1;
        return (voxel.x() & kMask) * kStrideX + (voxel.y() & kMask) * kStrideY + (voxel.z() & kMask);
    }
};

} // namespace vdbounce
