// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/implicit/surface_fit.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace vdbounce {

/// A bit for each voxel of a leaf, z fastest.
using VoxelSet = std::array<std::uint64_t, 8>;

inline bool contains(const VoxelSet& set, int v) { return (set[std::size_t(v >> 6)] >> (v & 63) & 1) != 0; }
inline void insert(int v, VoxelSet& set) { set[std::size_t(v >> 6)] |= std::uint64_t(1) << (v & 63); }
inline void erase(int v, VoxelSet& set) { set[std::size_t(v >> 6)] &= ~(std::uint64_t(1) << (v & 63)); }

/// For each voxel of an 8^3 leaf (z fastest) the way to a point of the surface.
struct FootLeaf {
    static constexpr int kVoxels = 512;
    static constexpr std::int32_t kNone = -1;
    static constexpr float kLost = -1.0f; ///< squared length of a voxel that is not to get a point any more

    Vec3i origin;                            ///< the leaf's first voxel
    std::array<std::int32_t, 6> neighbours;  ///< leaves beside the faces, -x, +x, -y, +y, -z, +z; -1: none
    alignas(64) float way[3][kVoxels];       ///< to the point, voxels (index space)
    alignas(64) float squared[kVoxels];      ///< its length squared, in units of VoxelMetric
    alignas(64) std::int32_t patch[kVoxels]; ///< the patch that the point is on; kNone where none is within reach
    VoxelSet unsure{};                       ///< voxels whose point may not be the closest of those around

    Vec3i voxel(int v) const { return origin + Vec3i(v >> 6, v >> 3 & 7, v & 7); }
};

/// The leaves around a surface, in lexicographic order.
using FootLeaves = std::vector<std::unique_ptr<FootLeaf>>;

/// The closest points of the surface for all voxels closer than `reach` (units of VoxelMetric). Where the surface is
/// cut off, what is beside its rim has none.
///
/// Method: each voxel beside a patch starts from that patch's point; points are handed from voxel to voxel, in sweeps
/// within leaves and from leaf to leaf (a vector distance transform, Danielsson 1980), so that each finds the nearest
/// or nearly so. Then each voxel finds the closest point on its patch, by Newton's method on the cubic or exactly on
/// the triangles. Where a neighbour has found a closer one, it is taken over, with its patch, and improved again. Where
/// the surface has kinks or the closest point is beyond the patch, the cells around are searched last. Leaves are swept
/// in two colours like a chess board's, so that the result does not depend on threads.
///
/// Throws UsageError for more than `maxLeaves` leaves, Interrupted.
FootLeaves findFeet(const FittedSurface& surface, const VoxelMetric& metric, float reach, std::uint64_t maxLeaves,
                    Progress& progress);

} // namespace vdbounce
