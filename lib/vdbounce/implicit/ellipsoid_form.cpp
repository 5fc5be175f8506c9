// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/ellipsoid_form.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vdbounce {
namespace {

// On a plane of symmetry a coordinate is 0, and the nearest point can be on either side: this share of the radius
// chooses one, too small to be seen in the result.
constexpr double kOffSymmetry = 1e-100;

// Newton's steps are done when they no longer change the root, mostly after five; rounding may let the last digit
// swing for ever.
constexpr int kMostSteps = 60;
constexpr double kSettled = 2.0 * std::numeric_limits<double>::epsilon();

} // namespace

EllipsoidForm::EllipsoidForm(const Vec3d& centre, const Vec3d& radii)
    : centre_(centre), radii_(radii), smallest_(radii.minCoeff() * radii.minCoeff()),
      above_((radii.array() - radii.minCoeff()) * (radii.array() + radii.minCoeff()))
{
}

EllipsoidForm::Root EllipsoidForm::rootFor(const Vec3d& fromCentre) const
{
    const Vec3d y = fromCentre.cwiseAbs().cwiseMax(kOffSymmetry * radii_);
    const Vec3d weighted = radii_.cwiseProduct(y);
    // s = t + the smallest e^2 keeps its digits where t comes close to minus that. Every single term of the sum is 1 or
    // more here, so the root lies above.
    double s = (weighted - above_).maxCoeff();
    for (int i = 0; i < kMostSteps; ++i) {
        const Vec3d terms = weighted.cwiseQuotient(above_ + Vec3d::Constant(s));
        const double sum = terms.squaredNorm();
        const double slope = terms.cwiseAbs2().cwiseQuotient(above_ + Vec3d::Constant(s)).sum(); // -1/2 of the sum's
        const double step = sum * (std::sqrt(sum) - 1.0) / slope;
        if (!(step > kSettled * s)) break;
        s += step;
    }
    return {s - smallest_, y.cwiseQuotient(above_ + Vec3d::Constant(s))};
}

double EllipsoidForm::phi(const Vec3d& p) const
{
    // y - x = t y / (t + e^2), which keeps its digits next to the surface.
    const Root root = rootFor(p - centre_);
    return root.t * root.scaled.norm();
}

Vec3d EllipsoidForm::gradient(const Vec3d& p) const
{
    const Vec3d fromCentre = p - centre_;
    const Vec3d normal = rootFor(fromCentre).scaled.normalized();
    return normal.binaryExpr(fromCentre, [](double n, double y) { return std::copysign(n, y); });
}

} // namespace vdbounce
