// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/foot_points.h"

#include <string>

namespace vdbounce {

/// What the values of the level set are cut off at, world units.
struct DistanceBand {
    float exterior; ///< also the background
    float interior;
};

/// Makes the level set of the distances to the feet: active within the band, the band's width with the side's sign
/// beyond. The sides are those of `samples`; where these do not tell, that of the foot's patch. The leaves are let
/// go on the way.
LevelSetGrid assembleDistances(FootLeaves leaves, const FittedSurface& surface, const ImplicitSamples& samples,
                               const VoxelMetric& metric, const DistanceBand& band, const std::string& name);

} // namespace vdbounce
