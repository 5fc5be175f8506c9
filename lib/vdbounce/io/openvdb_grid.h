// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/io/level_set_grid.h"
#include "vdbounce/io/scalar_grid.h"
#include "vdbounce/io/sidecar_grid.h"

#include <openvdb/openvdb.h>

/// @file
/// The door between vdbounce and code that uses OpenVDB itself.

namespace vdbounce {

struct LevelSetGrid::Holder {
    openvdb::FloatGrid::ConstPtr grid;
};

struct ScalarGrid::Holder {
    openvdb::FloatGrid::ConstPtr grid;
};

struct SidecarGrid::Holder {
    openvdb::GridBase::ConstPtr grid;
};

/// Shares `grid`; it must not be changed afterwards. Throws InputError unless it is a signed level set with a linear
/// transform and a positive, finite background; `place` names it in the error.
LevelSetGrid toLevelSetGrid(openvdb::FloatGrid::ConstPtr grid, const std::string& place);

inline const openvdb::FloatGrid& toOpenVdb(const LevelSetGrid& grid) { return *grid.holder().grid; }

/// Shares `grid`; it must not be changed afterwards.
inline ScalarGrid toScalarGrid(openvdb::FloatGrid::ConstPtr grid)
{
    return ScalarGrid(std::make_shared<ScalarGrid::Holder>(ScalarGrid::Holder{std::move(grid)}));
}

inline const openvdb::FloatGrid& toOpenVdb(const ScalarGrid& grid) { return *grid.holder().grid; }

/// Shares `grid`; it must not be changed afterwards.
inline SidecarGrid toSidecarGrid(openvdb::GridBase::ConstPtr grid)
{
    return SidecarGrid(std::make_shared<SidecarGrid::Holder>(SidecarGrid::Holder{std::move(grid)}));
}

inline const openvdb::GridBase& toOpenVdb(const SidecarGrid& grid) { return *grid.holder().grid; }

} // namespace vdbounce
