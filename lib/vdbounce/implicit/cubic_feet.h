// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/surface_patch.h"

namespace vdbounce {

/// Voxels, each with a smooth patch, of which the closest points are sought together. Positions are in voxels from the
/// centre of each patch's cell.
struct CubicFeet {
    static constexpr int kCount = 8;

    alignas(64) float cubic[Cubic::kTerms][kCount];
    alignas(64) float voxel[3][kCount];
    alignas(64) float foot[3][kCount]; ///< in: a start near the patch; out: the closest point of its zero line
    alignas(64) float step[kCount];    ///< out: how far the last step went, the largest component
    alignas(64) float squared[kCount]; ///< out: from voxel to foot, squared, in units of the metric
};

/// Newton's method on "the foot is on the zero line, and the way to it is along the gradient" (Lagrange), from a
/// start within a voxel. Where the lines from voxels to their feet meet, the surface's bend is left out, which is the
/// step of Chopp (2001). The same bits on every processor.
void findCubicFeet(CubicFeet& feet, const VoxelMetric& metric);

} // namespace vdbounce
