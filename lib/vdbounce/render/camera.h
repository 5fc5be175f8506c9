// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"
#include "vdbounce/base/vector.h"

namespace vdbounce {

/// A perspective camera over an image of given size; pixels count from the top left.
struct Camera {
    Vec3d eye;
    Vec3d forward;               ///< unit, into the picture
    Vec3d right;                 ///< unit
    Vec3d up;                    ///< unit
    double pixelsPerSlope = 1.0; ///< image pixels for a slope of 1 off the axis
    int width = 0;
    int height = 0;

    /// A direction of unit depth (along `forward`) through the middle of pixel x, y.
    Vec3d rayThrough(double x, double y) const
    {
        return forward + right * ((x + 0.5 - 0.5 * width) / pixelsPerSlope) +
               up * ((0.5 * height - y - 0.5) / pixelsPerSlope);
    }
};

/// A camera that sees all of `box`, from the side `view` points to (from the box towards the eye), with `up` upwards.
Camera frameBox(const Box& box, const Vec3d& view, const Vec3d& up, int width, int height);

} // namespace vdbounce
