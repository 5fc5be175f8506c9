// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/eikonal_residual.h"
#include "vdbounce/field/linear_transform.h"
#include "vdbounce/field/surface_measure.h"
#include "vdbounce/field/thin_features.h"
#include "vdbounce/field/value_range.h"
#include "vdbounce/io/level_set_grid.h"

#include <optional>
#include <string>

namespace vdbounce::tool {

/// The width of a narrow band on either side of the surface, world units.
struct Band {
    double exterior = 0.0;
    double interior = 0.0;
    bool wholeInterior = false; ///< every voxel inside holds a distance; `interior` is the deepest
};

/// What can be measured of a level set whose values are all finite.
struct LevelSetMeasures {
    Band band;
    bool clipped = false;  ///< its box cuts the surface off
    double steepest = 1.0; ///< how fast the values change at most
    EikonalResidual eikonal;
    SurfaceMeasure surface;
    ThinFeatures thin;
};

/// All that `info` knows of a level set.
struct LevelSetSurvey {
    std::string path;
    std::string gridClass; ///< as the file has it: "level set", "unknown"
    LevelSetSummary summary;
    LinearTransform transform;
    ValueRange range;
    std::optional<LevelSetMeasures> measures; ///< nothing where some values are not finite, or tiles
                                              ///< too large to look at without voxels between them
};

LevelSetSurvey surveyLevelSet(const LevelSetGrid& grid, const std::string& path, const std::string& gridClass);

} // namespace vdbounce::tool
