// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/block_layout.h"
#include "vdbounce/field/linear_transform.h"

namespace vdbounce {

/// Cells of a block, counted from its first row along each axis; `end` is behind the last.
struct CellRange {
    Vec3i begin = Vec3i::Zero();
    Vec3i end = Vec3i::Constant(BlockLayout::kRows - 1);
};

/// The squared length of the largest gradient that the trilinear interpolant can have in any of the block's cells
/// within the range, world space, from the largest difference along each axis of the cell; or `steepest` where none is
/// larger.
double steepestCell(const float (&block)[BlockLayout::kSize], const LinearTransform& transform, double steepest,
                    const CellRange& range = {});

} // namespace vdbounce
