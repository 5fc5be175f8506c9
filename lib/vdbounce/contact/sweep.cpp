// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/sweep.h"

#include "vdbounce/field/first_touch.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace vdbounce {
namespace {

// Steps shorter than this share of the length on which walls are told apart pass none: of a grid's the thinnest is two
// voxels thick, and half of one where the grid lies badly.
constexpr double kSweepFrom = 0.5;

// How far a piece of a curved path may be from it, voxels, and how many pieces there are at most.
constexpr double kSagittaVx = 0.05;
constexpr double kMostPieces = 1024.0;

// Strides through a deforming shape: the shortest, voxels, and how many at most.
constexpr double kShortestStrideVx = 0.25;
constexpr double kMostStrides = 1e5;

// Before a surface by formula: how straight the pieces of a path are, and how short strides are at least, as shares of
// it; and how many a path is worth that is shorter than what the surface resolves.
constexpr double kSagittaShare = 1e-3;
constexpr double kShortestStride = 1e-5;
constexpr double kFewestStrides = 8.0;

// Tangents from which a convex surface is looked for: each brings at least half of what is left, a few all of it; and
// the share of the way to it that the last one may still bring.
constexpr int kMostTangents = 100;
constexpr double kTangentShare = 1e-14;

// Halvings of a bracket that is a stride long: to a ten-millionth of it.
constexpr int kHalvings = 24;

// The share of a step over which a path's direction is taken.
constexpr double kDirectionShare = 1e-3;

using FieldPtr = std::shared_ptr<const DistanceField>;

// A particle's way in the frame of one collider.
class RelativePath {
public:
    RelativePath(const Placement& placement, const Vec3d& from, const Vec3d& to)
        : placement_(placement), from_(from), to_(to)
    {
    }

    Vec3d at(double share) const
    {
        const Vec3d world = from_ + share * (to_ - from_);
        return placement_.moves ? placement_.between(share).toLocal(world) : world;
    }

    // Pieces whose ends are on the path and that are straight to within `sagitta`.
    int pieces(double sagitta) const
    {
        if (!placement_.moves) return 1;
        const double angle = (placement_.end.rotation - placement_.begin.rotation).norm() / std::sqrt(2.0);
        if (!(angle > 0.0)) return 1;
        // Relative to the centre that it turns around, which goes straight from its place at the beginning to that now.
        const Vec3d centre = placement_.velocity.centre;
        const Vec3d first = placement_.begin.toWorld(placement_.end.toLocal(centre));
        const double way = ((to_ - from_) - (centre - first)).norm();
        const double arm = std::max((from_ - first).norm(), (to_ - centre).norm());
        // A curve of acceleration a is within a/8 of its chord over a unit of time.
        const double deviation = (angle * angle * arm + 2.0 * angle * way) / 8.0;
        return int(std::clamp(std::ceil(std::sqrt(deviation / sagitta)), 1.0, kMostPieces));
    }

private:
    const Placement& placement_;
    const Vec3d& from_;
    const Vec3d& to_;
};

std::optional<double> touchOf(const PlaneField& plane, const RelativePath& path, double radius,
                              const Placement& placement, double end)
{
    const int pieces = std::isfinite(placement.reach) ? 1 : 64; // a plane that turns
    double free = 0.0;
    for (int piece = 1; piece <= pieces; ++piece) {
        double inside = end * piece / pieces;
        if (plane.phi(path.at(inside)) - radius >= 0.0) {
            free = inside;
            continue;
        }
        for (int i = 0; i < 2 * kHalvings; ++i) {
            const double middle = 0.5 * (free + inside);
            (plane.phi(path.at(middle)) - radius < 0.0 ? inside : free) = middle;
        }
        return free;
    }
    return std::nullopt;
}

std::optional<double> touchOf(const FieldPtr& field, const RelativePath& path, double radius, const Placement&,
                              double end)
{
    const int pieces = path.pieces(kSagittaVx * field->voxelSize());
    for (int piece = 0; piece < pieces; ++piece) {
        const double begin = end * piece / pieces;
        const double length = end / pieces;
        if (const auto touch = firstTouch(*field, path.at(begin), path.at(begin + length), radius))
            return begin + *touch * length;
    }
    return std::nullopt;
}

// The last place known to be free, between one that is and one that is not.
template <class Gap> double halvedDown(const Gap& gap, double free, double inside)
{
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (free + inside);
        (gap(middle) < 0.0 ? inside : free) = middle;
    }
    return free;
}

std::optional<double> touchOf(const DeformingShape& shape, const RelativePath& path, double radius,
                              const Placement& placement, double end)
{
    const DeformingField& field = *shape.field;
    if (field.empty()) return std::nullopt;
    const auto gap = [&](double t) { return field.phi(path.at(t), shape.shareAt(placement.timeAt(t))) - radius; };
    const double length = (path.at(end) - path.at(0.0)).norm();
    if (!(length > 0.0)) return std::nullopt;
    const double shortest = end * std::max(kShortestStrideVx * field.voxelSize() / length, 1.0 / kMostStrides);
    double free = 0.0;
    for (double t = 0.0;;) {
        if (gap(t) < 0.0) {
            return halvedDown(gap, free, t);
        }
        if (t >= end) return std::nullopt;
        free = t;
        t = std::min(end, t + std::max(shortest, end * field.clearance(path.at(t), radius) / length));
    }
}

// A convex surface that rests, along a straight path: Newton's method from the free side stays there, since phi is
// above its tangents, and where a tangent rises the path has passed. So no wall is too thin to be found.
std::optional<double> touchOfConvex(const ImplicitField& field, const RelativePath& path, double radius, double end)
{
    const auto gap = [&](double t) { return field.phi(path.at(t), 0.0) - radius; };
    const Vec3d way = path.at(1.0) - path.at(0.0);
    double free = 0.0;
    for (int i = 0; i < kMostTangents; ++i) {
        const FieldSample here = field.sample(path.at(free), 0.0);
        const double clear = here.phi - radius;
        const double slope = here.gradient.dot(way);
        if (clear < 0.0) return 0.0; // only at the beginning
        if (!(slope < 0.0)) return std::nullopt;
        const double next = free - clear / slope;
        if (next > end) return gap(end) < 0.0 ? std::optional(halvedDown(gap, free, end)) : std::nullopt;
        if (gap(next) < 0.0) return halvedDown(gap, free, next); // by rounding
        if (!(next - free > kTangentShare * next)) return next;
        free = next;
    }
    return std::nullopt; // it touches without going in
}

// A surface by formula: strides that cannot reach it (conservative advancement, Mirtich 1996).
std::optional<double> touchOf(const std::shared_ptr<const ImplicitField>& field, const RelativePath& path,
                              double radius, const Placement& placement, double end)
{
    const auto gap = [&](double t) { return field->phi(path.at(t), placement.timeAt(t)) - radius; };
    const double length = (path.at(end) - path.at(0.0)).norm();
    const double sagitta = kSagittaShare * length;
    const int pieces = path.pieces(sagitta);
    const double moved = field->reach(placement.beginTime, placement.endTime);
    if (pieces == 1 && moved == 0.0 && field->convex()) return touchOfConvex(*field, path, radius, end);
    double free = 0.0;
    for (int piece = 0; piece < pieces; ++piece) {
        const double begin = end * piece / pieces;
        const double stop = end * (piece + 1) / pieces;
        // The curved way is longer than its chord by no more than this; and the surface comes to meet it.
        const double way = (path.at(stop) - path.at(begin)).norm() + 8.0 * sagitta + moved;
        const double speed = way * field->lipschitz() / (stop - begin);
        // A path that is short itself is not looked at more closely than it is worth.
        const double finest = std::max(kShortestStride * way, std::min(way / kFewestStrides, field->resolution()));
        const double shortest = finest * (stop - begin) / way;
        for (double t = begin;;) {
            const double clear = gap(t);
            if (clear < 0.0) return halvedDown(gap, free, t);
            free = t;
            if (t >= stop || !(speed > 0.0)) break;
            t = std::min(stop, t + std::max(shortest, clear / speed));
        }
    }
    return std::nullopt;
}

// Whether the way from one place to the other comes as near to the ball's centre as its radius.
bool meetsBall(const BoundingBall& ball, const Placement& placement, const Vec3d& from, const Vec3d& to, double radius)
{
    if (!std::isfinite(ball.radius)) return true;
    const Vec3d way = to - from;
    const double squared = way.squaredNorm();
    const double along = squared > 0.0 ? std::clamp((placement.ballCentre - from).dot(way) / squared, 0.0, 1.0) : 0.0;
    return (placement.ballCentre - from - along * way).norm() <= ball.radius + radius + placement.reach;
}

// Place and normal of a hit.
void describeHit(const PlacedColliders& colliders, const RelativePath& path, const Vec3d& from, const Vec3d& to,
                 PathHit& hit)
{
    const Placement& placement = colliders.placement(hit.collider);
    hit.position = from + hit.when * (to - from);
    const double time = placement.timeAt(hit.when);
    // The way that it takes there; a share of the step before, as the path may curve.
    const double before = std::max(0.0, hit.when - kDirectionShare);
    const Vec3d direction = path.at(before + kDirectionShare) - path.at(before);
    const Vec3d local = path.at(hit.when);
    hit.hasNormal = outwardNormalAgainst(colliders[hit.collider].shape, local, time, direction, hit.normal);
    if (hit.hasNormal && placement.moves) hit.normal = placement.between(hit.when).vectorToWorld(hit.normal);
}

} // namespace

bool sweepIsDue(Sweep sweep, double way, double wallLength)
{
    if (sweep == Sweep::Never) return false;
    return sweep == Sweep::Always || !(way <= kSweepFrom * wallLength);
}

PathHit sweepPath(const PlacedColliders& colliders, const Vec3d& from, const Vec3d& to, double radius, Sweep sweep)
{
    PathHit result;
    result.position = to;
    const double way = (to - from).norm();
    if (!std::isfinite((to - from).norm())) return result;
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        const Placement& placement = colliders.placement(i);
        if (!sweepIsDue(sweep, way + placement.reach, wallLengthOf(colliders[i].shape))) continue;
        if (!meetsBall(colliders.set().boundingBall(i), placement, from, to, radius)) continue;
        const RelativePath path(placement, from, to);
        // Later colliders only matter where they are met sooner.
        const auto touch =
            std::visit([&](const auto& shape) { return touchOf(shape, path, radius, placement, result.when); },
                       colliders[i].shape);
        if (!touch) continue;
        result.hit = true;
        result.when = *touch;
        result.collider = i;
    }
    if (!result.hit) return result;
    describeHit(colliders, RelativePath(colliders.placement(result.collider), from, to), from, to, result);
    return result;
}

} // namespace vdbounce
