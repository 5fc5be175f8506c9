// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/stencil.h"

namespace vdbounce {
namespace {

// Weights of the values at -1, 0, 1, 2 along one axis for a point at `t` between 0 and 1: of interpolating them, and of
// interpolating their central differences.
struct AxisWeights {
    explicit AxisWeights(double t)
        : value{0.0, 1.0 - t, t, 0.0}, difference{-0.5 * (1.0 - t), -0.5 * t, 0.5 * (1.0 - t), 0.5 * t}
    {
    }
    double value[4];
    double difference[4];
};

// Weights of the Catmull-Rom spline through four values, for a point at `t` between the second and the third, and of
// its derivative.
struct SplineWeights {
    explicit SplineWeights(double t)
        : value{0.5 * t * (t * (2.0 - t) - 1.0), 0.5 * (t * t * (3.0 * t - 5.0) + 2.0),
                0.5 * t * (t * (4.0 - 3.0 * t) + 1.0), 0.5 * t * t * (t - 1.0)},
          slope{0.5 * (t * (4.0 - 3.0 * t) - 1.0), 0.5 * t * (9.0 * t - 10.0), 0.5 * (t * (8.0 - 9.0 * t) + 1.0),
                0.5 * t * (3.0 * t - 2.0)}
    {
    }
    double value[4];
    double slope[4];
};

} // namespace

double trilinear(const float* values, int strideX, int strideY, const Vec3d& at)
{
    const auto alongZ = [&](const float* row) { return double(row[0]) * (1.0 - at.z()) + double(row[1]) * at.z(); };
    const auto alongYZ = [&](const float* plane) {
        return alongZ(plane) * (1.0 - at.y()) + alongZ(plane + strideY) * at.y();
    };
    return alongYZ(values) * (1.0 - at.x()) + alongYZ(values + strideX) * at.x();
}

FieldSample trilinearWithCellGradient(const float* values, int strideX, int strideY, const Vec3d& at)
{
    FieldSample sample;
    for (int corner = 0; corner < 8; ++corner) {
        const int side[3] = {corner & 1, corner >> 1 & 1, corner >> 2 & 1};
        const double value = double(values[side[0] * strideX + side[1] * strideY + side[2]]);
        double weight[3];
        for (int axis = 0; axis < 3; ++axis) weight[axis] = side[axis] == 1 ? at[axis] : 1.0 - at[axis];
        sample.phi += weight[0] * weight[1] * weight[2] * value;
        for (int axis = 0; axis < 3; ++axis) {
            const double others = weight[(axis + 1) % 3] * weight[(axis + 2) % 3];
            sample.gradient[axis] += (side[axis] == 1 ? others : -others) * value;
        }
    }
    return sample;
}

FieldSample trilinearWithGradient(const float* values, int strideX, int strideY, const Vec3d& at)
{
    const AxisWeights x(at.x());
    const AxisWeights y(at.y());
    const AxisWeights z(at.z());
    FieldSample sample;
    // The gradient along an axis reaches one voxel further on that axis only, so rows at the outer edge of both x
    // and y have no part in it.
    for (int i = 0; i < 4; ++i) {
        const bool outer = i == 0 || i == 3;
        for (int j = outer ? 1 : 0; j < (outer ? 3 : 4); ++j) {
            const float* row = values + i * strideX + j * strideY;
            const double interpolated = double(row[1]) * z.value[1] + double(row[2]) * z.value[2];
            sample.gradient.x() += x.difference[i] * y.value[j] * interpolated;
            sample.gradient.y() += x.value[i] * y.difference[j] * interpolated;
            if (outer || j == 0 || j == 3) continue;
            const double weight = x.value[i] * y.value[j];
            const double difference = double(row[0]) * z.difference[0] + double(row[1]) * z.difference[1] +
                                      double(row[2]) * z.difference[2] + double(row[3]) * z.difference[3];
            sample.phi += weight * interpolated;
            sample.gradient.z() += weight * difference;
        }
    }
    return sample;
}

FieldSample tricubic(const float* values, int strideX, int strideY, const Vec3d& at)
{
    const SplineWeights x(at.x());
    const SplineWeights y(at.y());
    const SplineWeights z(at.z());
    FieldSample sample;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            const float* row = values + i * strideX + j * strideY;
            double value = 0.0;
            double slope = 0.0;
            for (int k = 0; k < 4; ++k) {
                value += double(row[k]) * z.value[k];
                slope += double(row[k]) * z.slope[k];
            }
            sample.phi += x.value[i] * y.value[j] * value;
            sample.gradient += Vec3d(x.slope[i] * y.value[j] * value, x.value[i] * y.slope[j] * value,
                                     x.value[i] * y.value[j] * slope);
        }
    }
    return sample;
}

Vec3d centralDifferences(const float* values, int strideX, int strideY)
{
    const float* v = values + strideX + strideY + 1;
    const auto along = [&](int stride) { return 0.5 * (double(v[stride]) - double(v[-stride])); };
    return Vec3d(along(strideX), along(strideY), along(1));
}

} // namespace vdbounce
