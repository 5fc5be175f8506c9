// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/index_box.h"

#include <Eigen/LU>

#include <limits>

namespace vdbounce {
namespace {

enum class Side { Low, High, Free };

// Minimises |M (q - p)| over q with the coordinates that `sides` fixes at the box's sides. Solves the normal equations
// of the free ones; the result may lie outside of the box.
Vec3d closestOnFeature(const Box& box, const Vec3d& p, const Mat3d& metric, const Side (&sides)[3])
{
    Vec3d offset = Vec3d::Zero(); // q - p
    Mat3d system = Mat3d::Identity();
    Vec3d right = Vec3d::Zero();
    for (int axis = 0; axis < 3; ++axis) {
        if (sides[axis] != Side::Free) offset[axis] = (sides[axis] == Side::Low ? box.min : box.max)[axis] - p[axis];
    }
    for (int row = 0; row < 3; ++row) {
        if (sides[row] != Side::Free) continue;
        for (int column = 0; column < 3; ++column) {
            if (sides[column] == Side::Free) {
                system(row, column) = metric(row, column);
            } else {
                right[row] -= metric(row, column) * offset[column];
            }
        }
    }
    const Vec3d free = system.inverse() * right;
    for (int axis = 0; axis < 3; ++axis) {
        if (sides[axis] == Side::Free) offset[axis] = free[axis];
    }
    return p + offset;
}

} // namespace

Vec3d closestPointInBox(const Box& box, const Vec3d& index, const LinearTransform& transform)
{
    const Vec3d clamped = index.cwiseMax(box.min).cwiseMin(box.max);
    if (transform.orthogonal() || clamped == index) return clamped;

    const Mat3d metric = transform.indexToWorld().transpose() * transform.indexToWorld();
    constexpr Side kSides[3] = {Side::Low, Side::High, Side::Free};
    Vec3d best = clamped;
    double bestDistance = (clamped - index).dot(metric * (clamped - index));
    for (int feature = 0; feature < 26; ++feature) { // the 27th, all coordinates free, is the inside
        const Side sides[3] = {kSides[feature % 3], kSides[feature / 3 % 3], kSides[feature / 9]};
        const Vec3d candidate = closestOnFeature(box, index, metric, sides).cwiseMax(box.min).cwiseMin(box.max);
        const double distance = (candidate - index).dot(metric * (candidate - index));
        if (distance < bestDistance) {
            best = candidate;
            bestDistance = distance;
        }
    }
    return best;
}

} // namespace vdbounce
