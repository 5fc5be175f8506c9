// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"

namespace vdbounce {

/// A value and its gradient; index or world space as the function that returns it says.
struct FieldSample {
    double phi = 0.0;
    Vec3d gradient = Vec3d::Zero();
};

/// Trilinear interpolation of the 8 voxels around a point. `values` points at the voxel below the point in a
/// block of floats with the given strides (z is contiguous); `at` is the point's place in its cell, 0 to 1 an axis.
double trilinear(const float* values, int strideX, int strideY, const Vec3d& at);

/// The same with its own derivative, which jumps from cell to cell. Index space.
FieldSample trilinearWithCellGradient(const float* values, int strideX, int strideY, const Vec3d& at);

/// Trilinear phi and the trilinear interpolation of the central differences at the 8 voxels around the point, both in
/// index space (lecture, slide 28). Uses the 32 values within one voxel of the cell, of a 4^3 neighbourhood whose first
/// is one below the cell along each axis.
FieldSample trilinearWithGradient(const float* values, int strideX, int strideY, const Vec3d& at);

/// Catmull-Rom splines through the 4^3 values around a cell, along each axis in turn, and their derivative: C1 from
/// cell to cell, and equal to the voxels' values at their centres (Catmull and Rom 1974). Index space; `values` as
/// above.
FieldSample tricubic(const float* values, int strideX, int strideY, const Vec3d& at);

/// The central differences at the voxel at [1][1][1] of a 4^3 neighbourhood. Index space.
Vec3d centralDifferences(const float* values, int strideX, int strideY);

} // namespace vdbounce
