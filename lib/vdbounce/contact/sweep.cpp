// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/sweep.h"

#include <algorithm>

namespace vdbounce {
namespace {

// Halvings of the bracket, which is at most a step of advancement long: to a millionth of it and better.
constexpr int kBisections = 24;

} // namespace

PathHit sweepPath(const ColliderSet& colliders, const Vec3d& from, const Vec3d& to, double radius, double shortestStep)
{
    const Vec3d path = to - from;
    const double length = path.norm();
    const auto at = [&](double fraction) { return Vec3d(from + fraction * path); };
    PathHit result;
    result.position = to;
    double free = 0.0;
    double fraction = 0.0;
    Probe probe = colliders.probe(from, radius);
    while (!(probe.gap < 0.0)) {
        if (fraction >= 1.0 || !(length > 0.0)) return result;
        free = fraction;
        fraction = std::min(1.0, fraction + std::max(probe.clearance, shortestStep) / length);
        probe = colliders.probe(at(fraction), radius);
    }
    double inside = fraction;
    std::size_t collider = probe.collider;
    for (int i = 0; i < kBisections && inside > free; ++i) {
        const double middle = 0.5 * (free + inside);
        const Probe there = colliders.probe(at(middle), radius);
        if (there.gap < 0.0) {
            inside = middle;
            collider = there.collider;
        } else {
            free = middle;
        }
    }
    return {true, free, at(free), collider};
}

} // namespace vdbounce
