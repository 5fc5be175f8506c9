// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/build/band_leaves.h"

#include <cstdint>
#include <vector>

namespace vdbounce {

/// Throws UsageError when the regions of these leaves would take more than `maxMemory` bytes: they need something for
/// each leaf of the box around all, so that far-off parts cost.
void requireLatticeFits(const BandLeaves& leaves, std::uint64_t maxMemory);

/// The connected regions into which a mesh divides space, found on the voxels of its band and the empty leaves between.
///
/// Two neighbouring voxels are joined where their distances to the mesh add up to more than the way between them:
/// then no triangle can lie in between, so all of a region has one sign. What is not joined is not necessarily
/// apart: voxels close to the mesh often are regions of their own.
class SpaceRegions {
public:
    /// `leaves` with unsigned distances in lexicographic order, as measureBandLeaves returns them; `voxelSize` as in
    /// LinearTransform. Memory: 2 KB a leaf, 12 bytes for each leaf of the box around all.
    SpaceRegions(const BandLeaves& leaves, const Vec3d& voxelSize);

    struct Region {
        std::size_t deepestLeaf = 0; ///< where the region's voxel farthest from the mesh is
        int deepestVoxel = 0;
        float depth = -1.0f;    ///< its distance, world units
        bool outermost = false; ///< holds the space far away from the mesh
    };
    const std::vector<Region>& regions() const { return regions_; }

    /// The region of a voxel, an index into regions().
    std::uint32_t regionOf(std::size_t leaf, int voxel) const
    {
        return label_[leaf * BandLeaf::kVoxels + std::size_t(voxel)];
    }

    /// A leaf without any voxel in the band, between those that have.
    struct EmptyLeaf {
        Vec3i leaf;           ///< leaf coordinates
        std::uint32_t region; ///< an index into regions()
    };
    /// Those that do not belong to the outermost region, which goes on forever.
    const std::vector<EmptyLeaf>& emptyLeaves() const { return emptyLeaves_; }

private:
    std::vector<EmptyLeaf> emptyLeaves_;
    std::vector<Region> regions_;
    std::vector<std::uint32_t> label_;
};

} // namespace vdbounce
