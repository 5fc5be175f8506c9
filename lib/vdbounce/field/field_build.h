// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"
#include "vdbounce/field/leaf_blocks.h"
#include "vdbounce/field/linear_transform.h"
#include "vdbounce/io/level_set_grid.h"

namespace vdbounce {

/// What a DistanceField takes over from an OpenVDB grid.
struct FieldParts {
    LinearTransform transform;
    LeafBlocks blocks;
    Box indexBox; ///< of the active voxels' centres; empty when there are none
    float background = 0.0f;
    float interior = 0.0f; ///< what inactive voxels inside hold is -interior or less; infinite where there are none
};

/// Copies the grid's voxels into blocks, in parallel. Throws InputError for values that are not finite.
FieldParts buildFieldParts(const LevelSetGrid& grid);

/// The largest length that the gradient of the trilinear interpolant can have in any cell with a voxel in a leaf, world
/// space: from the largest difference along each axis of each cell. At least 1, so that it holds for distances too.
double lipschitzBound(const LeafBlocks& blocks, const LinearTransform& transform);

} // namespace vdbounce
