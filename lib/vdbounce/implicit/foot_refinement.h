// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/foot_points.h"

namespace vdbounce {

/// A bit for each voxel of a leaf, z fastest.
using VoxelSet = std::array<std::uint64_t, 8>;

inline bool contains(const VoxelSet& set, int v) { return (set[std::size_t(v >> 6)] >> (v & 63) & 1) != 0; }

/// Moves the points of those voxels to the closest ones on the same patches; leaves those alone for which none is found
/// that is closer. Beside a rim of the surface, where the closest point would be beyond, a voxel loses its
/// point for good. Voxels of the set without a point are passed over.
void refineFeet(const FittedSurface& surface, const VoxelMetric& metric, const VoxelSet& which, FootLeaf& leaf);

/// Whether the voxel lies where its patch's function grows, seen from its point.
bool outsideOfPatch(const FittedSurface& surface, const FootLeaf& leaf, int v);

} // namespace vdbounce
