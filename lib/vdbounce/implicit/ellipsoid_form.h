// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"
#include "vdbounce/base/vector.h"

namespace vdbounce {

/// An ellipsoid along the coordinate axes, with its true distance. See FormField for what a form has.
///
/// The nearest point x of the surface to y is where y - x is normal to it: x_i = e_i^2 y_i / (t + e_i^2), with t the
/// largest root of sum (e_i y_i / (t + e_i^2))^2 = 1 (Eberly 2013, "Distance from a point to an ellipse, an ellipsoid
/// or a hyperellipsoid"). One over the root of that sum is almost straight in t, so that Newton's steps on it come from
/// one side and are few (More and Sorensen 1983).
class EllipsoidForm {
public:
    static constexpr bool kConvex = true;

    EllipsoidForm(const Vec3d& centre, const Vec3d& radii);

    double phi(const Vec3d& p) const;
    Vec3d gradient(const Vec3d& p) const;
    Box box() const { return {centre_ - radii_, centre_ + radii_}; }
    double thinnestWall() const { return 2.0 * radii_.minCoeff(); }

private:
    struct Root {
        double t;
        Vec3d scaled; // y_i / (t + e_i^2): normal to the surface at the nearest point; not with y's signs
    };
    Root rootFor(const Vec3d& fromCentre) const;

    Vec3d centre_;
    Vec3d radii_;
    double smallest_; // radius, squared
    Vec3d above_;     // how much the squares of the radii are above that
};

} // namespace vdbounce
