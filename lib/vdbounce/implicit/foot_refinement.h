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

/// Moves the points of those voxels to the closest ones on the same patches; those for which none is found, and those
/// whose patch has kinks, become unsure. Beside a rim of the surface, where the closest point would be beyond, a voxel
/// loses its point for good. Voxels of the set without a point are passed over.
void refineFeet(const FittedSurface& surface, const VoxelMetric& metric, const VoxelSet& which, FootLeaf& leaf);

/// Which of a leaf's unsure voxels.
enum class Unsure {
    BeyondPatch, ///< those whose patch is smooth: few, but what they find helps their neighbours
    All,
};

/// Gives the leaf's unsure voxels the closest point on any patch of the cells around theirs, and again from there while
/// that comes closer.
void searchFeet(const FittedSurface& surface, const VoxelMetric& metric, Unsure which, FootLeaf& leaf);

/// Whether the voxel lies where its patch's function grows, seen from its point.
bool outsideOfPatch(const FittedSurface& surface, const FootLeaf& leaf, int v);

} // namespace vdbounce
