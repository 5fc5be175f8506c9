// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/sample_block.h"
#include "vdbounce/implicit/voxel_metric.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vdbounce {

/// A polynomial of the third degree in three variables.
struct Cubic {
    /// Of 1, x, y, z, x^2, y^2, z^2, xy, xz, yz, x^3, y^3, z^3, x^2 y, x^2 z, y^2 x, y^2 z, z^2 x, z^2 y, xyz.
    static constexpr int kTerms = 20;
    float c[kTerms];

    /// Value, gradient and second derivatives (xx, yy, zz, xy, xz, yz) at u.
    void at(const float (&u)[3], float& value, float (&gradient)[3], float (&second)[6]) const;
};

/// The part of a surface that crosses one cell of the grid.
///
/// Positions are in voxels from the cell's centre. Where the function is smooth the surface is the zero line of a
/// cubic fitted to the 32 voxels in the cell and beside its faces, which is off by the fourth derivatives. Where it
/// has a kink, or changes too fast for a cubic, it is triangles between the places on the cell's edges and diagonals
/// where linear interpolation changes its sign.
struct SurfacePatch {
    Cubic cubic;             ///< with triangles: the linear part only, for the side
    float at[3];             ///< a point of the surface in or near the cell
    std::int32_t cell[3];    ///< the voxel at the cell's lowest corner
    std::uint32_t triangles; ///< how many; 0 where the surface is smooth
    std::uint32_t firstTriangle;
    float reach;       ///< how far from its point the triangles go, units of the metric
    std::uint32_t rim; ///< the surface is cut off next to the cell
};

/// Three corners in space (VoxelMetric::toSpace of voxels from the cell's centre).
using PatchTriangle = std::array<Eigen::Vector3f, 3>;

/// The patches of the cells whose lowest corner lies in one leaf.
struct LeafPatches {
    std::vector<SurfacePatch> patches;
    std::vector<PatchTriangle> triangles;

    void clear()
    {
        patches.clear();
        triangles.clear();
    }
};

/// Finds all cells that the surface crosses and fits a patch to each. Cells in which the sign changes on an edge whose
/// ends are not both known are left out: there the grid was cut off, and no surface is known to be.
void fitPatches(const SampleBlock& block, const Vec3i& origin, const VoxelMetric& metric, LeafPatches& result);

} // namespace vdbounce
