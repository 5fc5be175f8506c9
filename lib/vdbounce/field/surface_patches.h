// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"
#include "vdbounce/field/block_layout.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vdbounce {

/// The zero surface in the cells of one block: what hangs together there, and where it goes on in the next blocks.
struct SurfacePatches {
    struct Patch {
        double area = 0.0;                ///< world units
        double volume = 0.0;              ///< of the cone over it with its tip at the block's first voxel, cubic voxels
        Vec3d vectorArea = Vec3d::Zero(); ///< index space, pointing outside: of the cone when its tip is elsewhere
        Vec3d place = Vec3d::Zero();      ///< a point on it, from the block's first voxel, index space
        bool open = false;                ///< it reaches the side of the box
    };
    std::vector<Patch> patches;

    /// For each axis the patches, by number, that cross the block's low and its high side, an entry for every edge
    /// there: what is entry i of one block's high side is entry i of the next block's low side.
    std::array<std::vector<std::uint16_t>, 3> low;
    std::array<std::vector<std::uint16_t>, 3> high;
};

/// The cells of a block within a box of voxels.
struct BlockCells {
    const float* values;  ///< a block in BlockLayout, from its first value
    Vec3i origin;         ///< the block's first voxel
    Vec3i boxMin, boxMax; ///< inclusive
};

/// Cuts cells into tetrahedra (see TetrahedraCut). `areaToWorld` carries vector areas from index to world space: the
/// transform's inverse transpose times the size of its determinant.
SurfacePatches cutSurface(const BlockCells& cells, const Mat3d& areaToWorld);

} // namespace vdbounce
