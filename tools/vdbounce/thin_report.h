// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report.h"

#include "vdbounce/field/thin_features.h"

#include <string>
#include <vector>

namespace vdbounce::tool {

/// Three voxels across give each side of a wall one of its own, and the middle one.
constexpr double kVoxelsAcross = 3.0;

/// Below this part of a voxel it is an edge, of no thickness, or a wall whose thickness rounding hides.
constexpr double kEdgeVx = 0.02;

Json thinJson(const ThinFeatures::Kind& kind);

/// What voxels of this size (the smallest side, world) are too large for, a sentence each for walls and gaps: how
/// many, the thinnest's place and thickness, and the voxel size that would do, a third of it.
std::vector<std::string> thinWarnings(const ThinFeatures& features, double voxelSize);

} // namespace vdbounce::tool
