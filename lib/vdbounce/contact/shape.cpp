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

using FieldPtr = std::shared_ptr<const DistanceField>;

BoundingBall ballOf(const Box& box) { return {box.centre(), 0.5 * box.size().norm()}; }
const BoundingBall kEverywhere{Vec3d::Zero(), kInfinity};

BoundingBall ballOf(const PlaneField&) { return kEverywhere; }
BoundingBall ballOf(const FieldPtr& field)
{
    if (field->empty()) return {};
    return field->clipped() ? kEverywhere : ballOf(field->worldBox());
}
BoundingBall ballOf(const DeformingShape& shape)
{
    const DistanceField& from = shape.field->from();
    const DistanceField& to = shape.field->to();
    if (from.clipped() || to.clipped()) return kEverywhere;
    Box box = from.worldBox();
    box.add(to.worldBox());
    return box.empty() ? BoundingBall{} : ballOf(box);
}

double voxelOf(const PlaneField&) { return kInfinity; }
double voxelOf(const FieldPtr& field) { return field->voxelSize(); }
double voxelOf(const DeformingShape& shape) { return shape.field->voxelSize(); }

Nearness nearness(const PlaneField& plane, const Vec3d& local, double radius, double)
{
    const double phi = plane.phi(local);
    return {phi, std::max(0.0, phi - radius)};
}
Nearness nearness(const FieldPtr& field, const Vec3d& local, double radius, double)
{
    if (field->empty()) return {kInfinity, kInfinity};
    const double phi = field->phi(local);
    return {phi, field->clearance(local, phi, radius)};
}
Nearness nearness(const DeformingShape& shape, const Vec3d& local, double radius, double share)
{
    if (shape.field->empty()) return {kInfinity, kInfinity};
    return {shape.field->phi(local, share), shape.field->clearance(local, radius)};
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
Gradients gradientsOf(const DeformingShape& shape, const Vec3d& local, double share)
{
    Gradients from;
    Gradients to;
    shape.field->from().gradients(local, from.central, from.slope);
    shape.field->to().gradients(local, to.central, to.slope);
    return {(1.0 - share) * from.central + share * to.central, (1.0 - share) * from.slope + share * to.slope};
}

// Of a deforming shape the one that it is becoming.
const DistanceField* fieldOf(const PlaneField&) { return nullptr; }
const DistanceField* fieldOf(const FieldPtr& field) { return field.get(); }
const DistanceField* fieldOf(const DeformingShape& shape) { return &shape.field->to(); }

} // namespace

BoundingBall ballAround(const Shape& shape)
{
    return std::visit([](const auto& form) { return ballOf(form); }, shape);
}

double voxelSizeOf(const Shape& shape)
{
    return std::visit([](const auto& form) { return voxelOf(form); }, shape);
}

double shareAt(const Shape& shape, double time)
{
    const auto* deforming = std::get_if<DeformingShape>(&shape);
    if (deforming == nullptr || !(deforming->end > deforming->begin)) return 0.0;
    return std::clamp((time - deforming->begin) / (deforming->end - deforming->begin), 0.0, 1.0);
}

Nearness nearnessOf(const Shape& shape, const Vec3d& local, double radius, double share)
{
    return std::visit([&](const auto& form) { return nearness(form, local, radius, share); }, shape);
}

bool outwardNormalAgainst(const Shape& shape, const Vec3d& local, double share, const Vec3d& direction, Vec3d& normal)
{
    const auto [gradient, slope] = std::visit([&](const auto& form) { return gradientsOf(form, local, share); }, shape);
    const bool pointsIn = gradient.dot(slope) < 0.0;
    const bool facesAway = gradient.dot(direction) > 0.0 && slope.dot(direction) < 0.0;
    const bool trusted = gradient.norm() > kSmallestGradient && !pointsIn && !facesAway;
    const Vec3d& chosen = trusted ? gradient : slope;
    const double length = chosen.norm();
    if (!(length > kSmallestGradient)) return false;
    normal = chosen / length;
    return true;
}

bool outwardNormal(const Shape& shape, const Vec3d& local, double share, Vec3d& normal)
{
    return outwardNormalAgainst(shape, local, share, Vec3d::Zero(), normal);
}

bool nearestOutsideOf(const Shape& shape, const Vec3d& local, Vec3d& way)
{
    const DistanceField* field = std::visit([](const auto& form) { return fieldOf(form); }, shape);
    if (field == nullptr) return false; // a plane's gradient never vanishes
    const auto outside = field->nearestOutside(local);
    if (!outside) return false;
    way = *outside - local;
    return true;
}

Vec3d deformationVelocity(const Shape& shape, const Vec3d& local, double share)
{
    const auto* deforming = std::get_if<DeformingShape>(&shape);
    return deforming == nullptr ? Vec3d(Vec3d::Zero()) : deforming->field->velocity(local, share);
}

} // namespace vdbounce
