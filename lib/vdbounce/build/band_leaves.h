// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/io/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vdbounce {

/// An 8^3 leaf of voxels near a mesh and the unsigned distances at its voxel centres.
struct BandLeaf {
    static constexpr int kSide = 8;
    static constexpr int kVoxels = kSide * kSide * kSide;

    Vec3i leaf;                          ///< leaf coordinates: voxel coordinates over 8
    std::array<float, kVoxels> distance; ///< world units, z fastest; infinite where the mesh is farther than the band

    Vec3i voxel(int offset) const { return leaf * kSide + Vec3i(offset >> 6, offset >> 3 & 7, offset & 7); }
};

/// All leaves with a voxel closer to the mesh than `band` (world units), in lexicographic order, with exact distances.
/// Voxel centres lie at multiples of `voxelSize`.
///
/// Method: triangles are counted into the leaves that their band reaches; then each leaf takes the minimum over
/// its own list, so that no leaf needs another and any number of threads gives the same bits.
std::vector<BandLeaf> measureBandLeaves(const TriangleMesh& mesh, double voxelSize, double band, Progress& progress);

} // namespace vdbounce
