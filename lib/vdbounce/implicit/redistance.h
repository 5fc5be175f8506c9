// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/length.h"
#include "vdbounce/base/progress.h"
#include "vdbounce/io/level_set_grid.h"
#include "vdbounce/io/scalar_grid.h"

#include <optional>
#include <string>

namespace vdbounce {

/// On which side of the surface a function's values are inside.
enum class Inside {
    Below, ///< where they are smaller than at the surface: signed distance, implicit functions as the lecture has them
    Above, ///< where they are larger: density, fog volumes
};

struct RedistanceOptions {
    double iso = 0.0; ///< the value at the surface, in units of the grid's values
    Inside inside = Inside::Below;
    /// The band outside and inside. Left out: that of the grid where it is a level set, else 3 voxels. In voxels: of
    /// the longest side.
    std::optional<Length> exterior;
    std::optional<Length> interior;
    std::string name; ///< of the result; empty: the grid's own
};

/// Signed distance to the surface on which `implicit` takes the value `iso`.
LevelSetGrid redistance(const ScalarGrid& implicit, const RedistanceOptions& options = {},
                        Progress& progress = Progress::none());

} // namespace vdbounce
