// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/shape.h"

#include <algorithm>
#include <limits>

namespace vdbounce {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A distance field's gradient has length 1. Well below that it says more about rounding and kinks than about the way
// out.
constexpr double kSmallestGradient = 1e-3;

// Steps of half this share of the thinnest wall of a shape by formula cut off no more of its bends than 1/8000 of it.
constexpr double kWallShare = 1.0 / 16.0;

using FieldPtr = std::shared_ptr<const DistanceField>;
using ImplicitPtr = std::shared_ptr<const ImplicitField>;

const BoundingBall kEverywhere{Vec3d::Zero(), kInfinity};

BoundingBall ballOf(const Box& box)
{
    if (box.empty()) return {};
    if (!box.size().allFinite()) return kEverywhere;
    return {box.centre(), 0.5 * box.size().norm()};
}

BoundingBall ballOf(const PlaneField&) { return kEverywhere; }
BoundingBall ballOf(const FieldPtr& field) { return field->clipped() ? kEverywhere : ballOf(field->worldBox()); }
BoundingBall ballOf(const DeformingShape& shape)
{
    const DistanceField& from = shape.field->from();
    const DistanceField& to = shape.field->to();
    if (from.clipped() || to.clipped()) return kEverywhere;
    Box box = from.worldBox();
    box.add(to.worldBox());
    return ballOf(box);
}
BoundingBall ballOf(const ImplicitPtr& field) { return ballOf(field->box()); }

double voxelOf(const PlaneField&) { return kInfinity; }
double voxelOf(const FieldPtr& field) { return field->voxelSize(); }
double voxelOf(const DeformingShape& shape) { return shape.field->voxelSize(); }
double voxelOf(const ImplicitPtr& field) { return field->voxelSize(); }

double phi(const PlaneField& plane, const Vec3d& local, double) { return plane.phi(local); }
double phi(const FieldPtr& field, const Vec3d& local, double) { return field->empty() ? kInfinity : field->phi(local); }
double phi(const DeformingShape& shape, const Vec3d& local, double time)
{
    return shape.field->empty() ? kInfinity : shape.field->phi(local, shape.shareAt(time));
}
double phi(const ImplicitPtr& field, const Vec3d& local, double time) { return field->phi(local, time); }

double clearance(const PlaneField&, const Vec3d&, double phi, double radius, double)
{
    return std::max(0.0, phi - radius);
}
double clearance(const FieldPtr& field, const Vec3d& local, double phi, double radius, double)
{
    return field->empty() ? kInfinity : field->clearance(local, phi, radius);
}
double clearance(const DeformingShape& shape, const Vec3d& local, double, double radius, double)
{
    return shape.field->clearance(local, radius);
}
double clearance(const ImplicitPtr& field, const Vec3d& local, double, double radius, double time)
{
    return field->clearance(local, radius, time);
}

// The gradient by central differences, and the derivative of phi as it is interpolated.
struct Gradients {
    Vec3d central;
    Vec3d slope;
};

Gradients gradientsOf(const PlaneField& plane, const Vec3d&, double) { return {plane.normal(), plane.normal()}; }
Gradients gradientsOf(const FieldPtr& field, const Vec3d& local, double)
{
    Gradients gradients;
    field->gradients(local, gradients.central, gradients.slope);
    return gradients;
}
Gradients gradientsOf(const DeformingShape& shape, const Vec3d& local, double time)
{
    const double share = shape.shareAt(time);
    Gradients from;
    Gradients to;
    shape.field->from().gradients(local, from.central, from.slope);
    shape.field->to().gradients(local, to.central, to.slope);
    return {(1.0 - share) * from.central + share * to.central, (1.0 - share) * from.slope + share * to.slope};
}
Gradients gradientsOf(const ImplicitPtr& field, const Vec3d& local, double time)
{
    const Vec3d gradient = field->sample(local, time).gradient;
    return {gradient, gradient};
}

bool wayOutside(const PlaneField&, const Vec3d&, double, Vec3d&) { return false; } // its gradient never vanishes
bool wayOutside(const FieldPtr& field, const Vec3d& local, double, Vec3d& way)
{
    const auto outside = field->nearestOutside(local);
    if (outside) way = *outside - local;
    return outside.has_value();
}
bool wayOutside(const DeformingShape& shape, const Vec3d& local, double, Vec3d& way)
{
    const auto outside = shape.field->to().nearestOutside(local); // the one that it is becoming
    if (outside) way = *outside - local;
    return outside.has_value();
}
bool wayOutside(const ImplicitPtr& field, const Vec3d& local, double time, Vec3d& way)
{
    return field->wayOutside(local, time, way);
}

} // namespace

BoundingBall ballAround(const Shape& shape)
{
    return std::visit([](const auto& form) { return ballOf(form); }, shape);
}

double voxelSizeOf(const Shape& shape)
{
    return std::visit([](const auto& form) { return voxelOf(form); }, shape);
}

double wallLengthOf(const Shape& shape)
{
    const auto* field = std::get_if<ImplicitPtr>(&shape);
    if (field == nullptr) return voxelSizeOf(shape);
    return std::min(kWallShare * (*field)->thinnestWall(), (*field)->voxelSize());
}

bool deforms(const Shape& shape)
{
    const auto* field = std::get_if<ImplicitPtr>(&shape);
    return field != nullptr ? !(*field)->still() : std::holds_alternative<DeformingShape>(shape);
}

double reachOf(const Shape& shape, double begin, double end)
{
    // The clearance of level sets that deform holds for both of them.
    const auto* field = std::get_if<ImplicitPtr>(&shape);
    return field != nullptr ? (*field)->reach(begin, end) : 0.0;
}

double phiOf(const Shape& shape, const Vec3d& local, double time)
{
    return std::visit([&](const auto& form) { return phi(form, local, time); }, shape);
}

Nearness nearnessOf(const Shape& shape, const Vec3d& local, double radius, double time)
{
    return std::visit(
        [&](const auto& form) {
            const double there = phi(form, local, time);
            return Nearness{there, clearance(form, local, there, radius, time)};
        },
        shape);
}

bool outwardNormalAgainst(const Shape& shape, const Vec3d& local, double time, const Vec3d& direction, Vec3d& normal)
{
    const auto [gradient, slope] = std::visit([&](const auto& form) { return gradientsOf(form, local, time); }, shape);
    const bool pointsIn = gradient.dot(slope) < 0.0;
    const bool facesAway = gradient.dot(direction) > 0.0 && slope.dot(direction) < 0.0;
    const bool trusted = gradient.norm() > kSmallestGradient && !pointsIn && !facesAway;
    const Vec3d& chosen = trusted ? gradient : slope;
    const double length = chosen.norm();
    if (!(length > kSmallestGradient)) return false;
    normal = chosen / length;
    return true;
}

bool outwardNormal(const Shape& shape, const Vec3d& local, double time, Vec3d& normal)
{
    return outwardNormalAgainst(shape, local, time, Vec3d::Zero(), normal);
}

bool nearestOutsideOf(const Shape& shape, const Vec3d& local, double time, Vec3d& way)
{
    return std::visit([&](const auto& form) { return wayOutside(form, local, time, way); }, shape);
}

Vec3d deformationVelocity(const Shape& shape, const Vec3d& local, double time)
{
    if (const auto* deforming = std::get_if<DeformingShape>(&shape))
        return deforming->field->velocity(local, deforming->shareAt(time));
    if (const auto* field = std::get_if<ImplicitPtr>(&shape)) return (*field)->velocity(local, time);
    return Vec3d::Zero();
}

} // namespace vdbounce
