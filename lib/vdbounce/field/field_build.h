// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"
#include "vdbounce/field/leaf_blocks.h"
#include "vdbounce/field/linear_transform.h"
#include "vdbounce/field/surface_tree.h"
#include "vdbounce/io/level_set_grid.h"

namespace vdbounce {

/// What a DistanceField takes over from an OpenVDB grid.
struct FieldParts {
    LinearTransform transform;
    LeafBlocks blocks;
    Box indexBox; ///< of the active voxels' centres; empty when there are none
    float background = 0.0f;
    SurfaceTree surface;
    /// The largest length of the trilinear interpolant's gradient where lookups read, world space; at least 1.
    double lipschitz = 1.0;
    float storageError = 0.0f; ///< largest difference between a voxel and what is kept of it
    float interior = 0.0f;     ///< what inactive voxels inside hold is -interior or less; infinite where there are none
};

/// Copies the grid's voxels into blocks, in parallel. Lookups within the index box read `beyondBox` voxels beyond it.
/// Throws InputError for values that are not finite.
FieldParts buildFieldParts(const LevelSetGrid& grid, Storage storage, int beyondBox);

} // namespace vdbounce
