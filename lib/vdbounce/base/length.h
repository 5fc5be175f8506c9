// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vdbounce {

/// A length as users give it: in world units, or in voxels ("3vx").
struct Length {
    double value = 0.0;
    bool inVoxels = false;

    double world(double voxelSize) const { return inVoxels ? value * voxelSize : value; }
    double voxels(double voxelSize) const { return inVoxels ? value : value / voxelSize; }
};

} // namespace vdbounce
