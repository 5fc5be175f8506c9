// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/block_layout.h"
#include "vdbounce/field/linear_transform.h"

namespace vdbounce {

/// The squared length of the largest gradient that the trilinear interpolant can have in any cell of the block, world
/// space, from the largest difference along each axis of the cell; or `steepest` where none is larger.
double steepestCell(const float (&block)[BlockLayout::kSize], const LinearTransform& transform, double steepest);

} // namespace vdbounce
