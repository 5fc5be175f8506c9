// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/linear_transform.h"
#include "vdbounce/io/level_set_grid.h"
#include "vdbounce/io/scalar_grid.h"

namespace vdbounce {

/// Where the voxels of a level set lie.
LinearTransform transformOf(const LevelSetGrid& grid);

/// Where the voxels of a grid of numbers lie.
LinearTransform transformOf(const ScalarGrid& grid);

} // namespace vdbounce
