// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/io/triangle_mesh.h"

#include <cstddef>
#include <cstdint>

namespace vdbounce {

/// Where the 8^3 voxel centres of a leaf lie, and how far from them the mesh matters.
struct LeafPlace {
    Vec3d origin;       ///< world position of the voxel at offset (0, 0, 0)
    Mat3d indexToWorld; ///< from voxel offsets to world; any invertible matrix
    Mat3d worldToIndex; ///< its inverse
    double reach = 0.0; ///< world distance beyond which a triangle need not be found
};

/// The nearest triangle of each voxel of a leaf, z fastest.
struct NearestInLeaf {
    static constexpr int kVoxels = 512;
    static constexpr std::uint32_t kNone = 0xffffffffu;

    alignas(64) float squared[kVoxels];          ///< distance squared, world units, within some 1e-6 of the leaf's size
    alignas(64) std::uint32_t triangle[kVoxels]; ///< of the mesh; kNone where none is within reach

    /// Nothing found yet, nothing beyond `reach` wanted.
    void clear(double reach);
};

/// Finds for each voxel which triangle of the list is nearest; of equally near ones the first in the list.
///
/// Method: seen from a leaf, the distances to a triangle's plane and to the lines and ends of its edges are linear
/// functions of the voxel's offset, so each costs a product and a sum a voxel, many voxels at a time. The functions are
/// made in double at the leaf's origin, so that neither the mesh's place nor a triangle's size costs precision.
/// Triangles without area count as their longest edge. The same bits on every processor.
///
/// Cost: proportional to the triangles, and to the rows of eight voxels that their reach touches.
void findNearestInLeaf(const TriangleMesh& mesh, const std::uint32_t* list, std::size_t count, const LeafPlace& place,
                       NearestInLeaf& nearest);

} // namespace vdbounce
