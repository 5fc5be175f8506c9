// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/linear_transform.h"
#include "vdbounce/implicit/implicit_field.h"

#include <cstdint>
#include <vector>

namespace vdbounce {

/// A cube of voxels: its lowest voxel and how many lie along its side.
struct VoxelCube {
    Vec3i origin;
    int side;
};

/// A box of voxels; both corners belong to it.
struct VoxelBox {
    Vec3i min;
    Vec3i max;

    bool empty() const { return (min.array() > max.array()).any(); }
    bool contains(const Vec3i& voxel) const
    {
        return (voxel.array() >= min.array()).all() && (voxel.array() <= max.array()).all();
    }
    /// Of the whole cube, or of any voxel of it.
    bool contains(const VoxelCube& cube) const
    {
        return contains(cube.origin) && contains(Vec3i(cube.origin + Vec3i::Constant(cube.side - 1)));
    }
    bool meets(const VoxelCube& cube) const
    {
        return (cube.origin.array() <= max.array()).all() && (cube.origin.array() + cube.side > min.array()).all();
    }
};

/// Where a field's band is.
struct BandCubes {
    std::vector<VoxelCube> leaves; ///< of 8^3, which may hold voxels of the band
    std::vector<VoxelCube> inside; ///< of any size, wholly deeper inside than the band
};

struct BandCubesOptions {
    double exterior = 0.0; ///< half widths of the band, world
    double interior = 0.0;
    double time = 0.0;           ///< of fields that move
    VoxelBox within{};           ///< cubes that do not meet it are left out
    std::uint64_t maxLeaves = 0; ///< more are refused with UsageError
};

/// Halves the box `within` down to leaves, level by level in a fixed order.
BandCubes findBandCubes(const ImplicitField& field, const LinearTransform& transform, const BandCubesOptions& options);

} // namespace vdbounce
