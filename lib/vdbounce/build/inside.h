// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/build/band_leaves.h"
#include "vdbounce/build/mesh_tree.h"

#include <array>
#include <vector>

namespace vdbounce {

/// How a point is told to be inside of a mesh.
enum class InsideTest {
    Winding, ///< the mesh winds around it more than half, in either direction: faces may all point inwards
    Parity,  ///< rays from it cross the mesh an odd number of times, by majority
    Flood,   ///< it cannot be reached from far away without crossing the mesh
};

/// Which voxels of the band, and which empty leaves between, are inside.
struct InsideFlags {
    std::vector<std::array<bool, BandLeaf::kVoxels>> voxels; ///< for every leaf
    std::vector<Vec3i> emptyLeaves;                          ///< leaf coordinates of leaves that are inside as a whole
};

/// Finds what is inside.
///
/// Asked once for each connected region of space (see SpaceRegions), since all of a region has one sign. Where the mesh
/// has holes (`closed` false) a region may reach through one from inside to outside; so some dozens of its voxels are
/// asked, and where they disagree, all of them. Flood leaves the slivers of voxels close to the mesh to winding.
InsideFlags findInside(const std::vector<BandLeaf>& leaves, const MeshTree& tree, InsideTest test, bool closed,
                       double voxelSize, const Progress& progress);

} // namespace vdbounce
