// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/leaf_blocks.h"
#include "vdbounce/field/linear_transform.h"

namespace vdbounce {

/// The largest length that the gradient of the trilinear interpolant can have anywhere, world space: from the largest
/// difference along each axis of each cell. At least 1, so that it holds for distances too.
double lipschitzBound(const LeafBlocks& blocks, const LinearTransform& transform);

} // namespace vdbounce
