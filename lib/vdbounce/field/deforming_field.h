// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/distance_field.h"
#include "vdbounce/field/velocity_field.h"

#include <memory>

namespace vdbounce {

/// A surface that changes its form from one level set to the next: phi is interpolated between the two, linearly in
/// time. `share` is the time that has passed, 0 at the first and 1 at the second.
///
/// Between narrow bands phi means something only where at least one of them holds a distance: the surface should
/// move less than the band is wide from one level set to the next.
class DeformingField {
public:
    using FieldPtr = std::shared_ptr<const DistanceField>;
    using VelocityPtr = std::shared_ptr<const VelocityField>;

    /// `seconds` (> 0) from the one to the other. Without velocity fields the surface's velocity is that of the change
    /// of phi, along the normal only.
    DeformingField(FieldPtr from, FieldPtr to, double seconds, VelocityPtr fromVelocity = nullptr,
                   VelocityPtr toVelocity = nullptr);

    double phi(const Vec3d& world, double share) const;
    FieldSample sample(const Vec3d& world, double share) const;

    /// Velocity of the surface near `world`, world units a second. Without velocity fields -(dphi/dt) n / |grad phi|,
    /// which keeps the point on its level (Osher and Fedkiw 2003, eq. 3.6); zero where there is no gradient.
    Vec3d velocity(const Vec3d& world, double share) const;

    /// A distance that can be travelled in any direction without phi becoming less than `radius` at whatever time from
    /// the one level set to the other: phi then lies between the two. World units, >= 0.
    double clearance(const Vec3d& world, double radius) const;

    bool empty() const { return from_->empty() && to_->empty(); }
    double voxelSize() const { return std::min(from_->voxelSize(), to_->voxelSize()); }
    double lipschitz() const { return std::max(from_->lipschitz(), to_->lipschitz()); }
    const DistanceField& from() const { return *from_; }
    const DistanceField& to() const { return *to_; }

private:
    FieldPtr from_;
    FieldPtr to_;
    double seconds_;
    VelocityPtr fromVelocity_;
    VelocityPtr toVelocity_;
};

} // namespace vdbounce
