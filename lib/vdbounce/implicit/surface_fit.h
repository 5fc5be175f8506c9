// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/implicit/implicit_samples.h"
#include "vdbounce/implicit/surface_patch.h"

#include <vector>

namespace vdbounce {

/// The whole surface of an implicit function, cell by cell.
struct FittedSurface {
    /// Patches of the cells whose lowest corner lies in the leaf at `origin` (voxel coordinates).
    struct Leaf {
        Vec3i origin;
        std::size_t begin;
        std::size_t end;
    };
    std::vector<SurfacePatch> patches;
    std::vector<PatchTriangle> triangles;
    std::vector<Leaf> leaves;         ///< in lexicographic order, none without patches
    std::vector<std::int32_t> ofCell; ///< for each leaf's 512 cells, z fastest, the patch; -1: none

    /// The patch of the cell whose lowest corner is that voxel; -1 where there is none. `leaf` is where it was found
    /// the last time, an index into `leaves`, and is kept for the next.
    std::int32_t patchOf(const Vec3i& cell, std::size_t& leaf) const;
};

FittedSurface fitSurface(const ImplicitSamples& samples, const VoxelMetric& metric, Progress& progress);

} // namespace vdbounce
