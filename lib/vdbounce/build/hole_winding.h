// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/build/band_leaves.h"
#include "vdbounce/build/solid_groups.h"
#include "vdbounce/field/linear_transform.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vdbounce {

/// The winding numbers of the caps of a group's holes in a leaf.
struct LeafWinding {
    std::uint32_t group;
    std::array<float, BandLeaf::kVoxels> value; ///< on the right side of every half at every voxel, and near enough
};

/// Those of the groups in `open` whose caps are so near to a leaf that crossings alone do not tell its signs.
///
/// Method: a block of voxels all of whose winding numbers lie between the same two halves needs none of them exactly;
/// blocks are halved until that is so. Cost: a few searches of the caps for a leaf, more only beside rims.
std::vector<LeafWinding> doubtfulWindings(const SolidGroups& solids, const std::vector<std::uint32_t>& open,
                                          const LinearTransform& transform, const Vec3i& leaf);

} // namespace vdbounce
