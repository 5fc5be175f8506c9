// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"
#include "vdbounce/base/vector.h"

#include <algorithm>
#include <cmath>

/// @file
/// Forms whose surface is a fixed distance from a point, a line or a circle. See FormField for what a form has.

namespace vdbounce {

/// Some direction perpendicular to `axis` (unit): one of many, but always the same.
inline Vec3d anyPerpendicular(const Vec3d& axis)
{
    Eigen::Index smallest = 0;
    axis.cwiseAbs().minCoeff(&smallest);
    return axis.cross(Vec3d::Unit(smallest)).normalized();
}

class SphereForm {
public:
    static constexpr bool kConvex = true;

    SphereForm(const Vec3d& centre, double radius) : centre_(centre), radius_(radius) {}

    double phi(const Vec3d& p) const { return (p - centre_).norm() - radius_; }
    Vec3d gradient(const Vec3d& p) const
    {
        const double away = (p - centre_).norm();
        return away > 0.0 ? Vec3d((p - centre_) / away) : Vec3d(Vec3d::UnitX());
    }
    Box box() const { return {centre_ - Vec3d::Constant(radius_), centre_ + Vec3d::Constant(radius_)}; }
    double thinnestWall() const { return 2.0 * radius_; }

private:
    Vec3d centre_;
    double radius_;
};

class CapsuleForm {
public:
    static constexpr bool kConvex = true;

    CapsuleForm(const Vec3d& from, const Vec3d& to, double radius)
        : from_(from), way_(to - from), squared_(way_.squaredNorm()), radius_(radius)
    {
    }

    double phi(const Vec3d& p) const { return offset(p).norm() - radius_; }
    Vec3d gradient(const Vec3d& p) const
    {
        const Vec3d away = offset(p);
        const double distance = away.norm();
        if (distance > 0.0) return away / distance;
        return squared_ > 0.0 ? anyPerpendicular(way_.normalized()) : Vec3d(Vec3d::UnitX());
    }
    Box box() const
    {
        Box box;
        box.add(from_);
        box.add(from_ + way_);
        return {box.min - Vec3d::Constant(radius_), box.max + Vec3d::Constant(radius_)};
    }
    double thinnestWall() const { return 2.0 * radius_; }

private:
    // From the nearest point of the line.
    Vec3d offset(const Vec3d& p) const
    {
        const double along = squared_ > 0.0 ? std::clamp((p - from_).dot(way_) / squared_, 0.0, 1.0) : 0.0;
        return p - from_ - along * way_;
    }

    Vec3d from_;
    Vec3d way_;
    double squared_;
    double radius_;
};

class TorusForm {
public:
    static constexpr bool kConvex = false;

    TorusForm(const Vec3d& centre, const Vec3d& axis, double major, double minor)
        : centre_(centre), axis_(axis.normalized()), major_(major), minor_(minor)
    {
    }

    double phi(const Vec3d& p) const
    {
        const double height = (p - centre_).dot(axis_);
        const double away = (p - centre_ - height * axis_).norm() - major_;
        return std::sqrt(away * away + height * height) - minor_;
    }
    Vec3d gradient(const Vec3d& p) const
    {
        const double height = (p - centre_).dot(axis_);
        const Vec3d outwards = p - centre_ - height * axis_;
        const double distance = outwards.norm();
        const Vec3d radial = distance > 0.0 ? Vec3d(outwards / distance) : anyPerpendicular(axis_);
        const Vec3d fromCircle = (distance - major_) * radial + height * axis_;
        const double away = fromCircle.norm();
        return away > 0.0 ? Vec3d(fromCircle / away) : axis_;
    }
    Box box() const
    {
        // A circle reaches as far along each coordinate as its plane is turned towards it.
        const Vec3d reach = major_ * (1.0 - axis_.array().square()).max(0.0).sqrt() + minor_;
        return {centre_ - reach, centre_ + reach};
    }
    double thinnestWall() const { return 2.0 * minor_; }

private:
    Vec3d centre_;
    Vec3d axis_;
    double major_;
    double minor_;
};

} // namespace vdbounce
