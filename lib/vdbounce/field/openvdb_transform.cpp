// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/openvdb_transform.h"

#include "vdbounce/field/grid_transform.h"

namespace vdbounce {

// OpenVDB multiplies row vectors from the left: world = index * affine.

LinearTransform toLinearTransform(const openvdb::math::Transform& transform)
{
    Mat3d matrix;
    const openvdb::Vec3d origin = transform.indexToWorld(openvdb::Vec3d(0.0));
    const openvdb::Mat4d affine = transform.baseMap()->getAffineMap()->getMat4();
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) matrix(column, row) = affine(row, column);
    }
    return LinearTransform(matrix, Vec3d(origin.x(), origin.y(), origin.z()));
}

LinearTransform transformOf(const LevelSetGrid& grid) { return toLinearTransform(toOpenVdb(grid).transform()); }

LinearTransform transformOf(const ScalarGrid& grid) { return toLinearTransform(toOpenVdb(grid).transform()); }

openvdb::math::Transform::Ptr toOpenVdb(const LinearTransform& transform)
{
    const Mat3d& linear = transform.indexToWorld();
    const Vec3d& origin = transform.origin();
    if (linear == Mat3d(linear(0, 0) * Mat3d::Identity()) && origin.isZero(0.0))
        return openvdb::math::Transform::createLinearTransform(linear(0, 0));
    openvdb::Mat4d affine = openvdb::Mat4d::identity();
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) affine(column, row) = linear(row, column);
        affine(3, row) = origin[row];
    }
    return openvdb::math::Transform::createLinearTransform(affine);
}

} // namespace vdbounce
