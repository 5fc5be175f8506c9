// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/field/linear_transform.h"
#include "vdbounce/io/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace vdbounce {

/// A value for each voxel of an 8^3 leaf, z fastest.
template <class Value> using LeafArray = std::array<Value, 512>;

/// An 8^3 leaf of voxels near a mesh and the distances at its voxel centres.
struct BandLeaf {
    static constexpr int kSide = 8;
    static constexpr int kVoxels = kSide * kSide * kSide;
    static constexpr std::uint32_t kNoTriangle = 0xffffffffu;

    Vec3i leaf;                ///< leaf coordinates: voxel coordinates over 8
    LeafArray<float> distance; ///< world units; infinite where the mesh is farther than the band; unsigned at first

    /// The nearest triangle of each voxel within the band, where it was asked for.
    std::unique_ptr<LeafArray<std::uint32_t>> triangle;

    /// How certain each voxel's sign is, 0 to 1, where that was asked for; null where all of it is.
    std::unique_ptr<LeafArray<float>> confidence;

    Vec3i voxel(int offset) const { return leaf * kSide + Vec3i(offset >> 6, offset >> 3 & 7, offset & 7); }
};

/// Leaves in lexicographic order, each by itself, so that those done with can be let go.
using BandLeaves = std::vector<std::unique_ptr<BandLeaf>>;

/// All leaves with a voxel closer to some triangles of a mesh than `band` (world units), in lexicographic order, with
/// exact distances: each that of a closest point in double precision, rounded to float. `transform` may be any;
/// distances are world.
///
/// Method: a cube around all is halved again and again, each part with the list of triangles that may be nearest to any
/// of its voxels, down to the leaves (see nearest_in_leaf.h). No leaf needs another, so any number of threads gives
/// the same bits, and nothing but the lists on the way down is held. `triangles` are numbers, in order, of those that
/// count.
BandLeaves measureBandLeaves(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles,
                             const LinearTransform& transform, double band, bool wantTriangles, Progress& progress);

} // namespace vdbounce
