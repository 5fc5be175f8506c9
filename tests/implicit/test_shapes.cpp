// SPDX-License-Identifier: Apache-2.0
#include "support/random.h"

#include "vdbounce/base/error.h"
#include "vdbounce/implicit/shapes.h"

#include <Eigen/Geometry>

#include <cmath>
#include <functional>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

// A shape, and what is known of it without its formula for distance: whether a point is inside, and points of its
// surface.
struct Known {
    ShapeFormula formula;
    std::function<bool(const Vec3d&)> inside;
    std::function<Vec3d(Random&)> onSurface;
};

Known knownSphere(const Vec3d& c, double r)
{
    return {SphereShape{c, r}, [=](const Vec3d& p) { return (p - c).squaredNorm() < r * r; },
            [=](Random& random) -> Vec3d { return c + r * random.direction(); }};
}

Known knownBox(const Vec3d& c, const Vec3d& half, const Eigen::Quaterniond& q)
{
    const Mat3d turn = q.normalized().toRotationMatrix();
    return {BoxShape{c, half, q},
            [=](const Vec3d& p) { return ((turn.transpose() * (p - c)).cwiseAbs().array() < half.array()).all(); },
            [=](Random& random) -> Vec3d {
                Vec3d at = random.in({-half, half});
                const int axis = int(random.uniform(0, 3));
                at[axis] = at[axis] < 0.0 ? -half[axis] : half[axis];
                return c + turn * at;
            }};
}

Known knownEllipsoid(const Vec3d& c, const Vec3d& radii)
{
    return {EllipsoidShape{c, radii}, [=](const Vec3d& p) { return (p - c).cwiseQuotient(radii).squaredNorm() < 1.0; },
            [=](Random& random) -> Vec3d { return c + radii.cwiseProduct(random.direction()); }};
}

Known knownTorus(const Vec3d& c, const Vec3d& axis, double major, double minor)
{
    const Vec3d n = axis.normalized();
    return {TorusShape{c, axis, major, minor},
            [=](const Vec3d& p) {
                // Its quartic: (|p|^2 + R^2 - r^2)^2 = 4 R^2 (distance from the axis)^2.
                const double h = (p - c).dot(n);
                const double s = (p - c).squaredNorm() + major * major - minor * minor;
                return s * s < 4.0 * major * major * ((p - c).squaredNorm() - h * h);
            },
            [=](Random& random) -> Vec3d {
                const Vec3d u = n.cross(random.direction()).normalized();
                const double angle = random.uniform(0, 2 * M_PI);
                return c + (major + minor * std::cos(angle)) * u + minor * std::sin(angle) * n;
            }};
}

// Cylinders, cones and cut cones.
Known knownFrustum(const ShapeFormula& formula, const Vec3d& from, const Vec3d& to, double bottom, double top)
{
    const double height = (to - from).norm();
    const Vec3d n = (to - from) / height;
    return {formula,
            [=](const Vec3d& p) {
                const double h = (p - from).dot(n);
                const double wide = bottom + (top - bottom) * h / height;
                return h > 0.0 && h < height && (p - from - h * n).norm() < wide;
            },
            [=](Random& random) -> Vec3d {
                const Vec3d u = n.cross(random.direction()).normalized();
                const double choice = random.uniform(0, 3);
                const double share = random.uniform(0, 1);
                if (choice < 1) return from + bottom * std::sqrt(share) * u;
                if (choice < 2) return to + top * std::sqrt(share) * u;
                return from + share * (to - from) + (bottom + (top - bottom) * share) * u;
            }};
}

Known knownCapsule(const Vec3d& from, const Vec3d& to, double r)
{
    const auto toLine = [=](const Vec3d& p) {
        const double t = (to - from).squaredNorm() > 0.0 ? (p - from).dot(to - from) / (to - from).squaredNorm() : 0.0;
        return (p - from - std::clamp(t, 0.0, 1.0) * (to - from)).eval();
    };
    return {CapsuleShape{from, to, r}, [=](const Vec3d& p) { return toLine(p).squaredNorm() < r * r; },
            [=](Random& random) -> Vec3d {
                // Out from the line until the ball at its end, or the tube, is left.
                const Vec3d foot = from + random.uniform(0, 1) * (to - from);
                const Vec3d u = random.direction();
                double low = 0.0;
                double high = 2.0 * (r + (to - from).norm());
                for (int i = 0; i < 60; ++i)
                    (toLine(foot + 0.5 * (low + high) * u).norm() < r ? low : high) = 0.5 * (low + high);
                return foot + low * u;
            }};
}

std::vector<Known> knownShapes()
{
    const Vec3d a(0.3, -0.2, 0.1);
    const Vec3d b(-0.4, 0.9, 0.5);
    return {knownSphere(a, 0.7),
            knownBox(a, Vec3d(0.5, 0.2, 0.8), Eigen::Quaterniond(0.9, 0.2, -0.4, 0.3)),
            knownCapsule(a, b, 0.3),
            knownCapsule(a, a, 0.3),
            knownFrustum(CylinderShape{a, b, 0.4}, a, b, 0.4, 0.4),
            knownFrustum(ConeShape{a, b, 0.6, 0.0}, a, b, 0.6, 0.0),
            knownFrustum(ConeShape{a, b, 0.2, 0.7}, a, b, 0.2, 0.7),
            knownTorus(a, Vec3d(0.2, 1.0, -0.5), 0.8, 0.25),
            knownEllipsoid(a, Vec3d(0.9, 0.3, 0.5)),
            knownEllipsoid(a, Vec3d(0.5, 0.5, 0.1)),
            knownEllipsoid(a, Vec3d(0.4, 0.4, 0.4))};
}

} // namespace

TEST_CASE("shapes have the distance to the nearest of many points of their surface, and their side's sign")
{
    VDBOUNCE_RANDOM(random);
    constexpr int kSurfacePoints = 40000;
    for (const Known& known : knownShapes()) {
        const auto field = makeField(known.formula);
        std::vector<Vec3d> surface;
        for (int i = 0; i < kSurfacePoints; ++i) surface.push_back(known.onSurface(random));
        double largestExcess = 0.0;
        for (int i = 0; i < 200; ++i) {
            const Vec3d p = random.in({Vec3d::Constant(-1.6), Vec3d::Constant(1.6)});
            double nearest = 1e9;
            for (const Vec3d& s : surface) nearest = std::min(nearest, (p - s).norm());
            const double phi = field->phi(p, 0.0);
            INFO(nameOf(known.formula) << " at " << p.transpose() << ": phi " << phi << ", nearest " << nearest);
            REQUIRE((phi < 0.0) == known.inside(p));
            REQUIRE(std::abs(phi) <= nearest + 1e-12); // no point of the surface is nearer
            largestExcess = std::max(largestExcess, nearest - std::abs(phi));
        }
        INFO(nameOf(known.formula));
        CHECK(largestExcess < 0.03); // the mean gap between the surface's points
    }
}

TEST_CASE("from anywhere, phi against the gradient leads to a shape's surface")
{
    VDBOUNCE_RANDOM(random);
    for (const Known& known : knownShapes()) {
        const auto field = makeField(known.formula);
        for (int i = 0; i < 2000; ++i) {
            const Vec3d p = random.in({Vec3d::Constant(-3), Vec3d::Constant(3)});
            const FieldSample sample = field->sample(p, 0.0);
            INFO(nameOf(known.formula) << " at " << p.transpose() << ": phi " << sample.phi);
            REQUIRE(sample.phi == field->phi(p, 0.0));
            REQUIRE(sample.gradient.norm() == Approx(1.0).margin(1e-12));
            const Vec3d foot = p - sample.phi * sample.gradient;
            REQUIRE(std::abs(field->phi(foot, 0.0)) < 1e-12);
            REQUIRE_FALSE(known.inside(foot + 1e-9 * sample.gradient));
            // Behind an edge the inside begins in some direction, but not always straight behind.
            bool insideNear = known.inside(foot - 1e-9 * sample.gradient);
            for (int k = 0; k < 2000 && !insideNear; ++k) insideNear = known.inside(foot + 1e-9 * random.direction());
            REQUIRE(insideNear);
        }
    }
}

TEST_CASE("the phi of a shape never changes faster than the way")
{
    VDBOUNCE_RANDOM(random);
    for (const Known& known : knownShapes()) {
        const auto field = makeField(known.formula);
        for (int i = 0; i < 5000; ++i) {
            const Vec3d p = random.in({Vec3d::Constant(-1.5), Vec3d::Constant(1.5)});
            const Vec3d way = std::pow(10.0, random.uniform(-6, 0)) * random.direction();
            REQUIRE(std::abs(field->phi(p + way, 0.0) - field->phi(p, 0.0)) <= way.norm() * (1.0 + 1e-9) + 1e-15);
        }
    }
}

TEST_CASE("a row of lookups has the same bits as one after the other")
{
    VDBOUNCE_RANDOM(random);
    for (const Known& known : knownShapes()) {
        const auto field = makeField(known.formula);
        for (int i = 0; i < 200; ++i) {
            const Vec3d from = random.in({Vec3d::Constant(-1.5), Vec3d::Constant(1.5)});
            const Vec3d step = 0.1 * random.direction();
            double row[11];
            field->phiInRow(from, step, 11, 0.0, row);
            for (int k = 0; k < 11; ++k) REQUIRE(row[k] == field->phi(from + double(k) * step, 0.0));
        }
    }
}

TEST_CASE("the box of a shape holds its surface and no more")
{
    VDBOUNCE_RANDOM(random);
    for (const Known& known : knownShapes()) {
        const Box box = makeField(known.formula)->box();
        Box seen;
        for (int i = 0; i < 200000; ++i) seen.add(known.onSurface(random));
        INFO(nameOf(known.formula) << ", box " << box.min.transpose() << " to " << box.max.transpose() << ", seen "
                                   << seen.min.transpose() << " to " << seen.max.transpose());
        CHECK((seen.min - box.min).minCoeff() > -1e-12);
        CHECK((box.max - seen.max).minCoeff() > -1e-12);
        CHECK((seen.min - box.min).maxCoeff() < 0.05);
        CHECK((box.max - seen.max).maxCoeff() < 0.05);
    }
}

TEST_CASE("where several places of the surface are nearest, the gradient is that of one of them")
{
    const std::pair<ShapeFormula, Vec3d> points[] = {
        {SphereShape{Vec3d(1, 2, 3), 0.5}, Vec3d(1, 2, 3)},
        {BoxShape{Vec3d(1, 2, 3), Vec3d(0.5, 0.5, 0.5)}, Vec3d(1, 2, 3)},
        {CapsuleShape{Vec3d(0, 0, 0), Vec3d(0, 1, 0), 0.2}, Vec3d(0, 0.5, 0)},
        {CylinderShape{Vec3d(0, 0, 0), Vec3d(0, 1, 0), 0.2}, Vec3d(0, 0.5, 0)},
        {ConeShape{Vec3d(0, 0, 0), Vec3d(0, 1, 0), 0.2, 0.0}, Vec3d(0, 0.2, 0)},
        {ConeShape{Vec3d(0, 0, 0), Vec3d(0, 1, 0), 0.2, 0.0}, Vec3d(0, 1, 0)}, // the tip itself
        {TorusShape{Vec3d(0, 0, 0), Vec3d(0, 1, 0), 1.0, 0.2}, Vec3d(0, 0, 0)},
        {TorusShape{Vec3d(0, 0, 0), Vec3d(0, 1, 0), 1.0, 0.2}, Vec3d(1, 0, 0)},
        {EllipsoidShape{Vec3d(1, 2, 3), Vec3d(1, 0.5, 0.25)}, Vec3d(1, 2, 3)},
        {EllipsoidShape{Vec3d(0, 0, 0), Vec3d(1, 1, 1)}, Vec3d(0, 0, 0)}};
    for (const auto& [formula, point] : points) {
        const auto field = makeField(formula);
        const FieldSample sample = field->sample(point, 0.0);
        INFO(nameOf(formula) << ": gradient " << sample.gradient.transpose());
        CHECK(sample.gradient.norm() == Approx(1.0).margin(1e-12));
        CHECK(std::abs(field->phi(point - sample.phi * sample.gradient, 0.0)) < 1e-12);
    }
    CHECK(makeField(EllipsoidShape{Vec3d::Zero(), Vec3d(1, 0.5, 0.25)})->phi(Vec3d::Zero(), 0.0) == Approx(-0.25));
}

TEST_CASE(
    "the distance to an ellipsoid is true for needles and discs, near and far, on planes of symmetry and off them")
{
    VDBOUNCE_RANDOM(random);
    for (int i = 0; i < 20000; ++i) {
        const auto size = [&] { return std::pow(10.0, random.uniform(-3, 3)); };
        const Vec3d radii(size(), size(), size());
        // From a known nearest point outwards along the normal the distance is known; inwards as long as no curvature
        // is passed, the smallest radius of which is that of the ends.
        Vec3d on = radii.cwiseProduct(random.direction());
        if (i % 3 == 0) on[i / 3 % 3] = 0.0;
        on *= 1.0 / on.cwiseQuotient(radii).norm();
        const Vec3d normal = on.cwiseQuotient(radii.cwiseAbs2()).normalized();
        const double bend = std::pow(radii.minCoeff(), 2.0) / radii.maxCoeff();
        const double away = i % 2 == 0 ? size() : -random.uniform(0, 0.99) * bend;
        const Vec3d p = on + away * normal;
        const FieldSample sample = makeField(EllipsoidShape{Vec3d::Zero(), radii})->sample(p, 0.0);
        INFO("radii " << radii.transpose() << ", at " << p.transpose() << ", " << away << " away: " << sample.phi);
        REQUIRE(sample.phi == Approx(away).epsilon(1e-9).margin(1e-12 * radii.maxCoeff()));
    }
}

TEST_CASE("a plane's distance is exact, and it has no end")
{
    const auto field = makeField(PlaneShape{Vec3d(0, 2, 0), Vec3d(0, 3, 4)});
    CHECK(field->phi(Vec3d(1, 2, 5), 0.0) == Approx(4.0));
    CHECK((field->sample(Vec3d::Zero(), 0.0).gradient - Vec3d(0, 0.6, 0.8)).norm() < 1e-15);
    CHECK_FALSE(field->box().size().allFinite());
}

TEST_CASE("shapes of no size or without direction are refused by name")
{
    const double nan = std::nan("");
    const std::pair<ShapeFormula, const char*> faults[] = {
        {PlaneShape{Vec3d::Zero(), Vec3d::Zero()}, "plane normal"},
        {PlaneShape{Vec3d(nan, 0, 0), Vec3d::UnitX()}, "plane point"},
        {SphereShape{Vec3d::Zero(), 0.0}, "sphere radius"},
        {SphereShape{Vec3d::Zero(), nan}, "sphere radius"},
        {BoxShape{Vec3d::Zero(), Vec3d(1, -1, 1)}, "box half"},
        {BoxShape{Vec3d::Zero(), Vec3d(1, 1, 1), Eigen::Quaterniond(0, 0, 0, 0)}, "box rotate"},
        {CapsuleShape{Vec3d::Zero(), Vec3d::UnitX(), -1.0}, "capsule radius"},
        {CylinderShape{Vec3d::UnitX(), Vec3d::UnitX(), 1.0}, "cylinder to"},
        {ConeShape{Vec3d::Zero(), Vec3d::UnitX(), 1.0, -0.1}, "cone top_radius"},
        {TorusShape{Vec3d::Zero(), Vec3d::UnitX(), 1.0, 1.0}, "torus minor"},
        {EllipsoidShape{Vec3d::Zero(), Vec3d(1, 0, 1)}, "ellipsoid radii"}};
    for (const auto& [formula, place] : faults) {
        const auto make = [formula = formula] { makeField(formula); };
        CHECK_THROWS_WITH(make(), Catch::StartsWith(place) && Catch::Contains(";"));
    }
}
