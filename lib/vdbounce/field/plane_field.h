// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/interval.h"
#include "vdbounce/field/stencil.h"

namespace vdbounce {

/// The half space behind a plane, with exact distance; the normal points out.
class PlaneField {
public:
    /// `normal` of any length but 0.
    PlaneField(const Vec3d& point, const Vec3d& normal) : normal_(normal.normalized()), offset_(normal_.dot(point)) {}

    double phi(const Vec3d& world) const { return normal_.dot(world) - offset_; }
    FieldSample sample(const Vec3d& world) const { return {phi(world), normal_}; }
    Interval bounds(const Vec3d& world) const { return {phi(world), phi(world)}; }
    const Vec3d& normal() const { return normal_; }

private:
    Vec3d normal_;
    double offset_;
};

} // namespace vdbounce
