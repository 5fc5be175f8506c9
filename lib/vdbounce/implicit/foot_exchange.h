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

/// A bit for each voxel of a leaf.
using VoxelSet = std::array<std::uint64_t, 8>;

/// Hands points from voxel to voxel within leaf `i`, starting from its own and from those of the leaves beside its
/// faces. True when a voxel took one over; which is noted in `changed` unless that is null.
bool exchangeFeet(FootLeaves& leaves, std::size_t i, const VoxelMetric& metric, Margin margin, VoxelSet* changed);

} // namespace vdbounce
