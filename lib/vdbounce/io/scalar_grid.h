// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/io/level_set_grid.h"

#include <memory>
#include <string>

namespace vdbounce {

/// An OpenVDB grid of float numbers that need not be distances: an implicit function, a fog volume, a level set that
/// lost its unit gradient. A handle, as LevelSetGrid is; `vdbounce/io/openvdb_grid.h` converts from and to
/// openvdb::FloatGrid.
class ScalarGrid {
public:
    struct Holder; ///< defined in openvdb_grid.h

    ScalarGrid() = default;
    explicit ScalarGrid(std::shared_ptr<const Holder> holder) : holder_(std::move(holder)) {}

    const Holder& holder() const { return *holder_; }

private:
    std::shared_ptr<const Holder> holder_;
};

/// The same grid, shared.
ScalarGrid toScalarGrid(const LevelSetGrid& grid);

/// The same grid, shared, if it can be one: throws InputError, naming `place`, for what readLevelSet() refuses.
LevelSetGrid toLevelSetGrid(const ScalarGrid& grid, const std::string& place);

/// Its grid class is "fog volume": density, larger inside.
bool isFogVolume(const ScalarGrid& grid);

/// Reads a grid of float, half or double of an OpenVDB file, whatever its class: the one called `gridName`, or without
/// a name the first level set, or else the first grid of numbers. Throws InputError as readLevelSet() does, and for a
/// transform that is not linear.
ScalarGrid readScalarGrid(const std::string& path, const std::string& gridName = "");

} // namespace vdbounce
