// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/deforming_field.h"

#include <algorithm>
#include <limits>

namespace vdbounce {
namespace {

// Below this a gradient is rounding and no direction.
constexpr double kSmallestGradient = 1e-3;

double clearanceTo(const DistanceField& field, const Vec3d& world, double radius)
{
    if (field.empty()) return std::numeric_limits<double>::infinity();
    return field.clearance(world, field.phi(world), radius);
}

} // namespace

DeformingField::DeformingField(FieldPtr from, FieldPtr to, double seconds, VelocityPtr fromVelocity,
                               VelocityPtr toVelocity)
    : from_(std::move(from)), to_(std::move(to)), seconds_(seconds), fromVelocity_(std::move(fromVelocity)),
      toVelocity_(std::move(toVelocity))
{
}

double DeformingField::phi(const Vec3d& world, double share) const
{
    return (1.0 - share) * from_->phi(world) + share * to_->phi(world);
}

FieldSample DeformingField::sample(const Vec3d& world, double share) const
{
    const FieldSample a = from_->sample(world);
    const FieldSample b = to_->sample(world);
    return {(1.0 - share) * a.phi + share * b.phi, (1.0 - share) * a.gradient + share * b.gradient};
}

Vec3d DeformingField::velocity(const Vec3d& world, double share) const
{
    if (fromVelocity_ && toVelocity_) return (1.0 - share) * fromVelocity_->at(world) + share * toVelocity_->at(world);
    if (fromVelocity_) return fromVelocity_->at(world);
    const Vec3d gradient = sample(world, share).gradient;
    const double steepness = gradient.squaredNorm();
    if (!(steepness > kSmallestGradient * kSmallestGradient)) return Vec3d::Zero();
    const double change = (to_->phi(world) - from_->phi(world)) / seconds_;
    return -change / steepness * gradient;
}

double DeformingField::clearance(const Vec3d& world, double radius) const
{
    return std::min(clearanceTo(*from_, world, radius), clearanceTo(*to_, world, radius));
}

} // namespace vdbounce
