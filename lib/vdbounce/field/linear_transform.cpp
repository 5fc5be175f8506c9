// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/linear_transform.h"

#include <Eigen/LU>

#include <cmath>

namespace vdbounce {
namespace {

// Cosine between two index axes below which they count as perpendicular: rounding of a rotation matrix in double.
constexpr double kPerpendicularCosine = 1e-12;

bool axesPerpendicular(const Mat3d& m)
{
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        if (std::abs(m.col(a).dot(m.col(b))) > kPerpendicularCosine * m.col(a).norm() * m.col(b).norm()) return false;
    }
    return true;
}

} // namespace

LinearTransform::LinearTransform(const Mat3d& indexToWorld, const Vec3d& origin)
    : indexToWorld_(indexToWorld), worldToIndex_(indexToWorld.inverse()), gradientToWorld_(worldToIndex_.transpose()),
      origin_(origin), voxelSize_(indexToWorld.colwise().norm().transpose()),
      orthogonal_(axesPerpendicular(indexToWorld))
{
}

double LinearTransform::voxelDiagonal() const
{
    double longest = 0.0;
    for (int signs = 0; signs < 4; ++signs) {
        const Vec3d diagonal(1.0, (signs & 1) != 0 ? -1.0 : 1.0, (signs & 2) != 0 ? -1.0 : 1.0);
        longest = std::max(longest, vectorToWorld(diagonal).norm());
    }
    return longest;
}

} // namespace vdbounce
