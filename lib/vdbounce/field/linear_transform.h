// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"

namespace vdbounce {

/// An affine map between index space, where voxel centres have whole coordinates, and world space. Any invertible
/// linear part: rotation, shear, mirroring, voxels that are longer along one axis.
class LinearTransform {
public:
    LinearTransform() : LinearTransform(Mat3d::Identity(), Vec3d::Zero()) {}

    /// world = indexToWorld * index + origin
    LinearTransform(const Mat3d& indexToWorld, const Vec3d& origin);

    Vec3d toIndex(const Vec3d& world) const
    {
        // In the order of the vector code, so that both find the same voxel half way between two.
        const Vec3d from = world - origin_;
        const auto along = [&](int row) {
            return (worldToIndex_(row, 0) * from.x() + worldToIndex_(row, 1) * from.y()) +
                   worldToIndex_(row, 2) * from.z();
        };
        return Vec3d(along(0), along(1), along(2));
    }
    Vec3d toWorld(const Vec3d& index) const { return indexToWorld_ * index + origin_; }
    Vec3d vectorToWorld(const Vec3d& index) const { return indexToWorld_ * index; }

    /// Carries a gradient by the inverse transpose, so that it stays perpendicular to the level sets.
    Vec3d gradientToWorld(const Vec3d& indexGradient) const { return gradientToWorld_ * indexGradient; }

    const Mat3d& indexToWorld() const { return indexToWorld_; }

    /// World length of a voxel's side along each index axis.
    const Vec3d& voxelSize() const { return voxelSize_; }
    double smallestVoxelSize() const { return voxelSize_.minCoeff(); }

    /// World length of a voxel's longest diagonal.
    double voxelDiagonal() const;

    const Mat3d& worldToIndex() const { return worldToIndex_; }
    const Mat3d& gradientToWorld() const { return gradientToWorld_; }
    const Vec3d& origin() const { return origin_; }

    /// True when the index axes are perpendicular in world space (no shear).
    bool orthogonal() const { return orthogonal_; }

private:
    Mat3d indexToWorld_;
    Mat3d worldToIndex_;
    Mat3d gradientToWorld_;
    Vec3d origin_;
    Vec3d voxelSize_;
    bool orthogonal_;
};

} // namespace vdbounce
