// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/io/openvdb_grid.h"

#include <optional>

/// @file
/// Solids without end. What is not in a body goes on for ever, but a level set's background is positive, so its grid
/// ends at a box, made of whole leaves, around all that is not of one kind. The grid's metadata hold that box; for
/// other programs it is where the solid ends, for set operations here the solid goes on beyond.

namespace vdbounce {

/// The box of a grid whose solid goes on beyond it; nothing for others.
std::optional<openvdb::CoordBBox> endlessBox(const openvdb::FloatGrid& grid);
void setEndlessBox(openvdb::FloatGrid& grid, const std::optional<openvdb::CoordBBox>& box);

/// Whole leaves around the band and all that is inside, and a band's width and a leaf more on each side.
openvdb::CoordBBox paddedBox(const openvdb::FloatGrid& grid);

/// What is not in `grid`, with its values negated; without end where `grid` has one, and the other way round. Name and
/// transform are the grid's.
openvdb::FloatGrid::Ptr complementOf(const openvdb::FloatGrid& grid, const Progress& progress);

/// A grid without end whose box holds `box`, too; others are handed back.
openvdb::FloatGrid::ConstPtr reachingTo(const openvdb::FloatGrid::ConstPtr& grid, const openvdb::CoordBBox& box,
                                        const Progress& progress);

/// A level set of that tree which is otherwise like `grid`: name and transform.
openvdb::FloatGrid::Ptr levelSetLike(const openvdb::FloatGrid& grid, openvdb::FloatTree::Ptr tree);

} // namespace vdbounce
