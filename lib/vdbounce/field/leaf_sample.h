// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"
#include "vdbounce/io/level_set_grid.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vdbounce {

/// The first voxels of at most `count` leaves with voxels within a voxel of the surface, evenly spread over the tree;
/// `seed` tells which. None where the level set has no surface.
std::vector<Vec3i> sampleLeaves(const LevelSetGrid& grid, std::size_t count, std::uint64_t seed);

/// Those leaves and the 26 places around each as they are in `grid`, and nothing else: what is measured in so small a
/// level set costs the same however large the whole is.
LevelSetGrid cutOut(const LevelSetGrid& grid, const std::vector<Vec3i>& leaves);

} // namespace vdbounce
