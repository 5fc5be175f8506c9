// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/foot_points.h"

namespace vdbounce {

/// Moves the point that voxel `v` has to the closest one on the same patch; leaves it where none is found that is
/// closer. Beside a rim of the surface, where the closest point would be beyond, the voxel loses its point.
void refineFoot(const FittedSurface& surface, const VoxelMetric& metric, FootLeaf& leaf, int v);

/// Whether the voxel lies where the patch's function grows, seen from its point.
bool outsideOfPatch(const FittedSurface& surface, const FootLeaf& leaf, int v);

} // namespace vdbounce
