// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/build/column_sign.h"
#include "vdbounce/field/linear_transform.h"
#include "vdbounce/io/level_set_grid.h"
#include "vdbounce/io/sidecar_grid.h"

#include <memory>
#include <string>
#include <vector>

namespace vdbounce {

/// What the values of a level set are cut off at, world units.
struct BandWidths {
    float exterior; ///< also the grid's background
    float interior;
};

struct AssembledGrids {
    LevelSetGrid levelSet;
    SidecarGrid closest;    ///< whole numbers, where the leaves have triangles
    SidecarGrid confidence; ///< where it was asked for
};

/// Makes an OpenVDB level set of signed leaves: active where phi is within the band, the band's width with the sign
/// beyond, and tiles inside. The leaves are let go on the way, so that they and the grid are not both held as a whole.
AssembledGrids assembleLevelSet(BandLeaves leaves, const std::vector<InsideRun>& inside,
                                const LinearTransform& transform, const BandWidths& band, const std::string& name,
                                bool wantConfidence);

} // namespace vdbounce
