// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/build/band_leaves.h"
#include "vdbounce/build/column_sign.h"
#include "vdbounce/build/mesh_tree.h"
#include "vdbounce/field/linear_transform.h"

#include <vector>

namespace vdbounce {

/// How a point is told to be inside of a mesh that columns of crossings say nothing certain about.
enum class InsideTest {
    Parity, ///< rays from it cross the mesh an odd number of times, by majority
    Flood,  ///< it cannot be reached from far away without crossing the mesh
};

/// Gives the distances of `leaves` their sign, negative inside, and returns which leaves between are inside.
///
/// Asked once for each connected region of space (see SpaceRegions), since all of a region has one sign. Where the mesh
/// has holes (`closed` false) a region may reach through one from inside to outside; so some dozens of its voxels are
/// asked, and where they disagree, all of them. Flood leaves the slivers of voxels close to the mesh to parity.
std::vector<InsideRun> signByRegions(BandLeaves& leaves, const MeshTree& tree, InsideTest test, bool closed,
                                     const LinearTransform& transform, const Progress& progress);

/// Notes in `leaves` how sure five rays from each voxel of the band are of its side: 1 where they all agree, 0.2 where
/// three are against two.
void askRaysForConfidence(BandLeaves& leaves, const MeshTree& tree, const LinearTransform& transform,
                          const Progress& progress);

} // namespace vdbounce
