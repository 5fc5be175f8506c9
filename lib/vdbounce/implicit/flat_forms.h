// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"
#include "vdbounce/base/vector.h"
#include "vdbounce/implicit/round_forms.h"

#include <algorithm>
#include <cmath>
#include <limits>

/// @file
/// Forms with flat sides and sharp edges. See FormField for what a form has.

namespace vdbounce {

/// For grids and CSG. Contact has field/plane_field.h by value instead, which paths meet in closed form.
class PlaneForm {
public:
    static constexpr bool kConvex = true;

    PlaneForm(const Vec3d& point, const Vec3d& normal) : normal_(normal.normalized()), offset_(normal_.dot(point)) {}

    double phi(const Vec3d& p) const { return normal_.dot(p) - offset_; }
    Vec3d gradient(const Vec3d&) const { return normal_; }
    Box box() const { return {Vec3d::Constant(-kEndless), Vec3d::Constant(kEndless)}; }
    double thinnestWall() const { return kEndless; }

private:
    static constexpr double kEndless = std::numeric_limits<double>::infinity();

    Vec3d normal_;
    double offset_;
};

class BoxForm {
public:
    static constexpr bool kConvex = true;

    BoxForm(const Vec3d& centre, const Vec3d& half, const Mat3d& rotation)
        : centre_(centre), half_(half), rotation_(rotation)
    {
    }

    double phi(const Vec3d& p) const
    {
        const Vec3d beyond = (rotation_.transpose() * (p - centre_)).cwiseAbs() - half_;
        return beyond.cwiseMax(0.0).norm() + std::min(0.0, beyond.maxCoeff());
    }
    Vec3d gradient(const Vec3d& p) const
    {
        const Vec3d local = rotation_.transpose() * (p - centre_);
        const Vec3d beyond = local.cwiseAbs() - half_;
        const Vec3d side = local.unaryExpr([](double x) { return x < 0.0 ? -1.0 : 1.0; });
        const Vec3d outside = beyond.cwiseMax(0.0);
        const double away = outside.norm();
        if (away > 0.0) return rotation_ * Vec3d(outside.cwiseProduct(side) / away);
        Eigen::Index nearest = 0;
        beyond.maxCoeff(&nearest);
        return side[nearest] * rotation_.col(nearest);
    }
    Box box() const
    {
        const Vec3d reach = rotation_.cwiseAbs() * half_;
        return {centre_ - reach, centre_ + reach};
    }
    double thinnestWall() const { return 2.0 * half_.minCoeff(); }

private:
    Vec3d centre_;
    Vec3d half_;
    Mat3d rotation_;
};

/// A cylinder, a cone or a cut cone: what its outline, a polygon of the distance from the axis and the height along it,
/// sweeps out around the axis. The nearest point lies in the half plane of the point itself, so the outline's three
/// edges tell the distance.
class FrustumForm {
public:
    static constexpr bool kConvex = true;

    FrustumForm(const Vec3d& from, const Vec3d& to, double radius, double topRadius)
        : from_(from), axis_((to - from).normalized()), height_((to - from).norm()), radius_(radius), top_(topRadius)
    {
    }

    double phi(const Vec3d& p) const
    {
        const Place place = placeOf(p);
        const Outline nearest = nearestOutline(place.at);
        return inside(place.at) ? -nearest.away.norm() : nearest.away.norm();
    }
    Vec3d gradient(const Vec3d& p) const
    {
        const Place place = placeOf(p);
        const Outline nearest = nearestOutline(place.at);
        const double away = nearest.away.norm();
        // From the surface itself nothing points away: there the normal of its side tells.
        const bool apart = away > kOnSurface * (height_ + radius_ + top_);
        Eigen::Vector2d out = apart ? Eigen::Vector2d(nearest.away / away) : nearest.normal;
        if (apart && inside(place.at)) out = -out;
        const Vec3d radial = place.at.x() > 0.0 ? Vec3d(place.outwards / place.at.x()) : anyPerpendicular(axis_);
        return out.x() * radial + out.y() * axis_;
    }
    Box box() const
    {
        const Vec3d turned = (1.0 - axis_.array().square()).max(0.0).sqrt();
        const Vec3d to = from_ + height_ * axis_;
        Box box;
        for (const double sign : {-1.0, 1.0}) {
            box.add(from_ + sign * radius_ * turned);
            box.add(to + sign * top_ * turned);
        }
        return box;
    }
    double thinnestWall() const { return std::min(height_, 2.0 * std::max(radius_, top_)); }

private:
    using Vec2d = Eigen::Vector2d; // distance from the axis, height

    // Nearer to the surface than this share of the form's size the way from its nearest point is rounding.
    static constexpr double kOnSurface = 1e-14;

    struct Place {
        Vec3d outwards; // from the axis
        Vec2d at;
    };
    struct Outline {
        Vec2d away; // from the outline's nearest point
        Vec2d normal;
    };

    Place placeOf(const Vec3d& p) const
    {
        const double height = (p - from_).dot(axis_);
        const Vec3d outwards = p - from_ - height * axis_;
        return {outwards, Vec2d(outwards.norm(), height)};
    }

    bool inside(const Vec2d& at) const
    {
        return at.y() > 0.0 && at.y() < height_ && at.x() * height_ < radius_ * (height_ - at.y()) + top_ * at.y();
    }

    Outline nearestOutline(const Vec2d& at) const
    {
        const Vec2d slope = Vec2d(top_ - radius_, height_);
        const double along = (at - Vec2d(radius_, 0.0)).dot(slope) / slope.squaredNorm();
        Outline nearest{at - Vec2d(radius_, 0.0) - std::clamp(along, 0.0, 1.0) * slope,
                        Vec2d(height_, radius_ - top_).normalized()};
        const auto consider = [&](const Vec2d& away, const Vec2d& normal) {
            if (away.squaredNorm() < nearest.away.squaredNorm()) nearest = {away, normal};
        };
        consider(Vec2d(at.x() - std::min(at.x(), radius_), at.y()), Vec2d(0.0, -1.0));
        consider(Vec2d(at.x() - std::min(at.x(), top_), at.y() - height_), Vec2d(0.0, 1.0));
        return nearest;
    }

    Vec3d from_;
    Vec3d axis_;
    double height_;
    double radius_; // at the bottom
    double top_;    // and at the top
};

} // namespace vdbounce
