// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/implicit/grid_csg_rule.h"
#include "vdbounce/io/openvdb_grid.h"

namespace vdbounce {

/// How far from the surface the grid's values are known: outside the background, inside what inactive tiles hold, or
/// where there are none of them, inactive voxels. Cost: of the first such tile; where there is none, of all masks.
CsgBand csgBandOf(const openvdb::FloatGrid& grid);

/// The rule applied to every voxel of two trees with the same index space, node beside node from the root down. Parts
/// of a tree that lie where the other decides are not looked at. Nodes without voxels of their own become tiles. In
/// parallel, with the same result for any number of threads. Throws Interrupted.
openvdb::FloatTree::Ptr combineTrees(const CsgRule& rule, const openvdb::FloatTree& a, const openvdb::FloatTree& b,
                                     const Progress& progress);

} // namespace vdbounce
