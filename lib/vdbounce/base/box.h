// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"

#include <algorithm>
#include <limits>

namespace vdbounce {

/// An axis-aligned box, world or index space as its owner says. Empty until something is added.
struct Box {
    Vec3d min = Vec3d::Constant(std::numeric_limits<double>::infinity());
    Vec3d max = Vec3d::Constant(-std::numeric_limits<double>::infinity());

    bool empty() const { return (min.array() > max.array()).any(); }
    Vec3d centre() const { return 0.5 * (min + max); }
    Vec3d size() const { return max - min; }
    bool contains(const Vec3d& p) const { return (p.array() >= min.array()).all() && (p.array() <= max.array()).all(); }

    void add(const Vec3d& p)
    {
        min = min.cwiseMin(p);
        max = max.cwiseMax(p);
    }
    void add(const Box& other)
    {
        min = min.cwiseMin(other.min);
        max = max.cwiseMax(other.max);
    }
};

/// Distance from `p` to the nearest point of `box`, squared; 0 inside.
inline double distanceSquared(const Box& box, const Vec3d& p)
{
    return (p - p.cwiseMax(box.min).cwiseMin(box.max)).squaredNorm();
}

/// A stretch of a ray, in multiples of its direction; empty when it ends before it begins.
struct Span {
    double begin = 0.0;
    double end = 0.0;
};

/// The part of `span` in which origin + t direction lies in the box.
inline Span clipToBox(const Box& box, const Vec3d& origin, const Vec3d& direction, Span span)
{
    for (int axis = 0; axis < 3; ++axis) {
        const double t0 = (box.min[axis] - origin[axis]) / direction[axis];
        const double t1 = (box.max[axis] - origin[axis]) / direction[axis];
        // NaN, of a ray within a side's plane, leaves the span as it is.
        if (std::min(t0, t1) > span.begin) span.begin = std::min(t0, t1);
        if (std::max(t0, t1) < span.end) span.end = std::max(t0, t1);
    }
    return span;
}

} // namespace vdbounce
