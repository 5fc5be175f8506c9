// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/implicit/grid_csg_rule.h"
#include "vdbounce/io/openvdb_grid.h"

/// @file
/// redistance() for set operations: of grids without end, too, and where nothing is left.

namespace vdbounce {

/// Whether any voxel of a leaf is inside: where none is there is no surface, which lies between values of both signs.
/// Ends at the first.
bool hasVoxelInside(const openvdb::FloatGrid& grid);

/// True distances in that band; without a voxel where nothing is inside. The side of the box of a grid without end,
/// which only stands for what goes on beyond, is no surface.
openvdb::FloatGrid::Ptr redistanced(const openvdb::FloatGrid& grid, const CsgBand& band, Progress& progress);

/// The grid with a band of at least that width: what it knows stays, to the bit, and redistance() adds the rest. Handed
/// back as it is where it has the band, or where its box cuts the surface off, so that nothing is known of what is
/// beyond.
openvdb::FloatGrid::ConstPtr widened(const openvdb::FloatGrid::ConstPtr& grid, const CsgBand& band, Progress& progress);

} // namespace vdbounce
