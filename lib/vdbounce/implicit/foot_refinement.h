// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/foot_points.h"

namespace vdbounce {

/// By how much a point must be closer to be taken over from a neighbour: squared < factor * own - offset.
struct Margin {
    float factor;
    float offset;

    /// Of patches' points: more than rounding, or the same point would be handed to and fro forever.
    static constexpr Margin ofPoints() { return {0.9999f, 1e-5f}; }

    /// Points on the surface which the neighbour has found for itself: a thousandth of a voxel, or one would go
    /// on taking over what is equally good.
    static constexpr Margin ofRefined() { return {0.999f, 1e-4f}; }
};

/// A bit for each voxel of a leaf, z fastest.
using VoxelSet = std::array<std::uint64_t, 8>;

inline bool contains(const VoxelSet& set, int v) { return (set[std::size_t(v >> 6)] >> (v & 63) & 1) != 0; }

inline void insert(int v, VoxelSet& set) { set[std::size_t(v >> 6)] |= std::uint64_t(1) << (v & 63); }

/// Moves the points of those voxels to the closest ones on the same patches; and on those of the cells around, wherever
/// the surface has kinks or the closest point is beyond the patch. Beside a rim of the surface, where the closest point
/// would be beyond, a voxel loses its point for good. Voxels of the set without a point are passed over.
void refineFeet(const FittedSurface& surface, const VoxelMetric& metric, const VoxelSet& which, FootLeaf& leaf);

/// Whether the voxel lies where its patch's function grows, seen from its point.
bool outsideOfPatch(const FittedSurface& surface, const FootLeaf& leaf, int v);

} // namespace vdbounce
