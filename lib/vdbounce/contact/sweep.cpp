// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/sweep.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace vdbounce {
namespace {

// Halvings of the bracket, which is at most a step of advancement long: to a ten-millionth of it.
constexpr int kBisections = 24;

// Advances along one path at most: a box of 10,000 voxels crossed a quarter of a voxel at a time.
constexpr double kMostAdvances = 1e5;

// A straight path by its length, so that a point on it keeps its precision however long it is.
struct Path {
    Vec3d from;
    Vec3d direction; // unit
    double radius;
    double shortestStep;

    Vec3d at(double way) const { return from + way * direction; }
};

// Between a way that is free and one that is not.
struct Bracket {
    double free;
    double inside;
};

std::optional<Bracket> bracketTouch(const PlaneField& plane, const Path& path, double length)
{
    // The gap to a plane is linear along the path, so its end tells all.
    if (plane.phi(path.at(length)) - path.radius >= 0.0) return std::nullopt;
    return Bracket{0.0, length};
}

std::optional<Bracket> bracketTouch(const std::shared_ptr<const DistanceField>& field, const Path& path, double length)
{
    if (field->empty()) return std::nullopt;
    Span span{0.0, length};
    if (!field->clipped()) {
        // phi outside the box is at least the distance to it.
        Box reach = field->worldBox();
        reach.min -= Vec3d::Constant(path.radius);
        reach.max += Vec3d::Constant(path.radius);
        span = clipToBox(reach, path.from, path.direction, span);
    }
    const double shortest = std::max(path.shortestStep, (span.end - span.begin) / kMostAdvances);
    double free = span.begin;
    double way = span.begin;
    while (way <= span.end) {
        const Vec3d here = path.at(way);
        const double phi = field->phi(here);
        if (phi - path.radius < 0.0) return Bracket{free, way};
        if (way == span.end) break;
        const double clearance = (field->freeDistance(here, phi) - path.radius) / field->lipschitz();
        free = way;
        way = std::min(span.end, std::max(way + std::max(clearance, shortest), std::nextafter(way, span.end)));
    }
    return std::nullopt;
}

double gapTo(const PlaneField& plane, const Vec3d& p, double radius) { return plane.phi(p) - radius; }
double gapTo(const std::shared_ptr<const DistanceField>& field, const Vec3d& p, double radius)
{
    return field->phi(p) - radius;
}

} // namespace

PathHit sweepPath(const ColliderSet& colliders, const Vec3d& from, const Vec3d& to, double radius, double shortestStep)
{
    PathHit result;
    result.position = to;
    double length = (to - from).norm();
    if (!(length > 0.0) || !std::isfinite(length)) return result;
    const Path path{from, (to - from) / length, radius, shortestStep};
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        std::visit(
            [&](const auto& shape) {
                auto bracket = bracketTouch(shape, path, length);
                if (!bracket) return;
                for (int k = 0; k < kBisections; ++k) {
                    const double middle = 0.5 * (bracket->free + bracket->inside);
                    (gapTo(shape, path.at(middle), radius) < 0.0 ? bracket->inside : bracket->free) = middle;
                }
                // Later colliders only matter where they are met sooner.
                length = bracket->free;
                result = {true, path.at(length), i};
            },
            colliders[i].shape);
    }
    return result;
}

} // namespace vdbounce
