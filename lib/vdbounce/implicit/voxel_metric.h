// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/linear_transform.h"

namespace vdbounce {

/// How long index-space vectors are in space, in units of a voxel's longest side: |A v| with the metric A^T A. For any
/// linear transform.
struct VoxelMetric {
    double unit;    ///< the longest side, world units
    Mat3d toSpace;  ///< A
    Mat3d toIndex;  ///< its inverse
    float g[6];     ///< of A^T A: xx, yy, zz, xy, xz, yz
    float shortest; ///< no vector of length 1 in index space is shorter than this in space

    explicit VoxelMetric(const LinearTransform& transform)
        : unit(transform.voxelSize().maxCoeff()), toSpace(transform.indexToWorld() / unit),
          toIndex(transform.worldToIndex() * unit)
    {
        const Mat3d m = toSpace.transpose() * toSpace;
        const double values[6] = {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)};
        for (int i = 0; i < 6; ++i) g[i] = float(values[i]);
        shortest = float(transform.orthogonal() ? toSpace.colwise().norm().minCoeff() : 1.0 / toIndex.norm());
    }

    /// A^T A v
    void apply(const float (&v)[3], float (&result)[3]) const
    {
        result[0] = g[0] * v[0] + g[3] * v[1] + g[4] * v[2];
        result[1] = g[3] * v[0] + g[1] * v[1] + g[5] * v[2];
        result[2] = g[4] * v[0] + g[5] * v[1] + g[2] * v[2];
    }
    float squared(const float (&v)[3]) const
    {
        float m[3];
        apply(v, m);
        return v[0] * m[0] + v[1] * m[1] + v[2] * m[2];
    }
};

} // namespace vdbounce
