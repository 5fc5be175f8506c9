// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/foot_refinement.h"

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

/// Hands points from voxel to voxel within leaf `i`, starting from its own and from those of the leaves beside its
/// faces; where it is not `fresh` only the latter are new to its voxels. True when a voxel took one over; `changed`
/// becomes those that did.
bool exchangeFeet(FootLeaves& leaves, std::size_t i, const VoxelMetric& metric, Margin margin, bool fresh,
                  VoxelSet& changed);

} // namespace vdbounce
