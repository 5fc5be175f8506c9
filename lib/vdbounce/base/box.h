// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"

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

} // namespace vdbounce
