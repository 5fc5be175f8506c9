// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/io/level_set_grid.h"
#include "vdbounce/io/scalar_grid.h"
#include "vdbounce/io/sidecar_grid.h"

#include <string>
#include <vector>

namespace vdbounce {

/// Reads the level set of an OpenVDB file: the one called `gridName`, or without a name the first that is one.
/// Throws InputError for what is no .vdb file, for a file without a level set (naming what it holds instead), and for a
/// grid that cannot be one: a fog volume, an unsigned field, a transform that is not linear.
LevelSetGrid readLevelSet(const std::string& path, const std::string& gridName = "");

struct GridWriteOptions {
    bool half = false; ///< store the level set's values as 16-bit floats: half the size, 11 bits of precision
    std::vector<SidecarGrid> beside; ///< written into the same file behind the level set; empty ones are passed over
};

/// Writes the grid whole or not at all. Equal grids give equal files.
void writeLevelSet(const LevelSetGrid& grid, const std::string& path, const GridWriteOptions& options = {});

/// What a .vdb file holds, grid by grid.
struct GridEntry {
    std::string name;
    std::string valueType; ///< OpenVDB's name of the value type, "float", "ptdataidx32", ...
    std::string gridClass; ///< "level set", "fog volume", "staggered", "unknown"
    bool isPoints = false;
    bool linear = true; ///< its transform is an affine map, as all that we read must have
};
std::vector<GridEntry> listGrids(const std::string& path);

} // namespace vdbounce
