// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report.h"

#include "vdbounce/field/thin_features.h"

#include <string>
#include <vector>

namespace vdbounce::tool {

Json thinJson(const ThinFeatures::Kind& kind);

/// What voxels of this size (the smallest side, world) are too large for, a sentence each for walls and gaps: how
/// many, the thinnest's place and thickness, and the voxel size that would do, a third of it.
std::vector<std::string> thinWarnings(const ThinFeatures& features, double voxelSize);

} // namespace vdbounce::tool
