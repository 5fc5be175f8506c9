// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"
#include "vdbounce/field/leaf_blocks.h"
#include "vdbounce/field/linear_transform.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace vdbounce {

/// Where the surface of a level set runs, to within two voxels, for bounds on the distance far from it.
///
/// Every point of the surface lies nearest to some voxel, and is at most half a voxel's diagonal away from it: so the
/// cubes of 2^3 voxels with a value that small cover the surface. Each leaf keeps which of its 4^3 cubes those are, and
/// a tree of boxes over the leaves, eight to a box, finds the nearest in the way of Roussopoulos, Kelley and Vincent
/// (1995). Provided that the voxels hold true distances.
///
/// Cost: 100 bytes a leaf that the surface crosses; some microseconds a search.
class SurfaceTree {
public:
    /// What is known of one leaf: a bit for each of its 4^3 cubes.
    struct Leaf {
        Vec3i origin;
        std::uint64_t surface = 0; ///< the surface may run through it
        std::uint64_t exits = 0;   ///< it holds a voxel outside, phi > 0, that is as near to the surface as neighbours
                                   ///< are to each other
    };

    /// The cubes of the leaf at `origin` whose values lie in `block`. Voxels beside `indexBox` are left out: they hold
    /// the background, which is no distance where all of the box is active. `error` is how far values may be off.
    static Leaf leafOf(const float (&block)[BlockLayout::kSize], const Vec3i& origin, const Box& indexBox,
                       const LinearTransform& transform, double error);

    SurfaceTree() = default;

    /// Leaves without either are left out.
    SurfaceTree(const std::vector<Leaf>& leaves, const LinearTransform& transform);

    /// A cube of 2^3 voxels: its first voxel, and a lower bound on the world distance to what it holds.
    struct Cube {
        Vec3i voxel;
        double distance;
    };

    /// The nearest cube that the surface may run through; nothing where there is no surface.
    std::optional<Cube> nearestSurface(const Vec3d& index) const { return nearest(index, &Leaf::surface); }

    /// The nearest that holds a voxel outside, phi > 0, beside the surface.
    std::optional<Cube> nearestExit(const Vec3d& index) const { return nearest(index, &Leaf::exits); }

    std::size_t memoryBytes() const;

private:
    static constexpr std::size_t kChildren = 8;

    using Cubes = std::uint64_t Leaf::*;
    struct Search;

    std::optional<Cube> nearest(const Vec3d& index, Cubes cubes) const;
    void visit(std::size_t level, std::size_t node, Search& search) const;
    Box boxOfCubes(const Vec3i& firstVoxel, const Vec3i& lastVoxel) const;
    void sortLeaves();
    void buildLevels();

    // Distances are measured in a frame that is a rotation of the world: its coordinates are frame_ times those of
    // index space, the upper triangle of the transform's QR decomposition.
    Mat3d frame_ = Mat3d::Identity();
    std::array<Vec3d, 64> cubeOffsets_; // from a leaf's first cube to each of them, in the frame
    Vec3d cubeHalf_ = Vec3d::Zero();    // half the size of a cube's box
    std::vector<Leaf> leaves_;
    std::vector<std::vector<Box>> levels_; // [0] the leaves' boxes, [n + 1] around eight of [n]; the last has one
};

} // namespace vdbounce
