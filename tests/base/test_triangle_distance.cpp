// SPDX-License-Identifier: Apache-2.0
#include "support/random.h"

#include "vdbounce/base/triangle_distance.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

// 113 bits, so that the differences of products that this takes of doubles are good for triangles of any kind below.
using Quad = boost::multiprecision::cpp_bin_float_quad;
using Point = std::array<Quad, 3>;
using Triangle = std::array<Vec3d, 3>;

Point exact(const Vec3d& v) { return {v.x(), v.y(), v.z()}; }
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point along(const Point& a, const Point& way, const Quad& share)
{
    return {a[0] + share * way[0], a[1] + share * way[1], a[2] + share * way[2]};
}
Quad dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Quad segmentDistanceSquared(const Point& p, const Point& a, const Point& b)
{
    const Point way = minus(b, a);
    const Quad length2 = dot(way, way);
    Quad share = length2 > 0 ? Quad(dot(minus(p, a), way) / length2) : Quad(0);
    share = share < 0 ? Quad(0) : share > 1 ? Quad(1) : share;
    const Point rest = minus(p, along(a, way, share));
    return dot(rest, rest);
}

double bruteForceDistance(const Vec3d& from, const Triangle& triangle)
{
    const Point p = exact(from);
    const Point a = exact(triangle[0]);
    const Point b = exact(triangle[1]);
    const Point c = exact(triangle[2]);
    Quad least = std::min(segmentDistanceSquared(p, a, b),
                          std::min(segmentDistanceSquared(p, b, c), segmentDistanceSquared(p, c, a)));
    const Point normal = cross(minus(b, a), minus(c, a));
    const Quad normal2 = dot(normal, normal);
    if (normal2 > 0) {
        const Quad height = dot(minus(p, a), normal);
        const Point foot = along(p, normal, -height / normal2);
        const bool within = dot(cross(minus(b, a), minus(foot, a)), normal) >= 0 &&
                            dot(cross(minus(c, b), minus(foot, b)), normal) >= 0 &&
                            dot(cross(minus(a, c), minus(foot, c)), normal) >= 0;
        if (within) least = std::min(least, Quad(height * height / normal2));
    }
    return std::sqrt(double(least));
}

constexpr int kKinds = 4;

// About a unit long and `thin` wide, anywhere within ten units: with a short edge, with a tip above or beyond the
// longest edge, or all three corners anywhere. The corners come in any order.
Triangle triangleOf(int kind, double thin, Random& random)
{
    const Vec3d at = 10.0 * random.direction();
    const Vec3d way = random.direction();
    const Vec3d aside = thin * random.direction();
    Triangle triangle;
    switch (kind) {
    case 0: triangle = {at, at + way, at + way + aside}; break;
    case 1: triangle = {at, at + way, at + random.uniform(0.1, 0.9) * way + aside}; break;
    case 2: triangle = {at, at + way, at - random.uniform(0.1, 0.9) * way + aside}; break;
    default: triangle = {at, at + way, at + random.direction()}; break;
    }
    std::rotate(triangle.begin(), triangle.begin() + int(random.uniform(0.0, 3.0)), triangle.end());
    return triangle;
}

// Above, beside or beyond the triangle, near by in terms of its width or far in terms of its length.
Vec3d pointNear(const Triangle& t, double thin, Random& random)
{
    const Vec3d beside = t[0] + random.uniform(-0.2, 1.2) * (t[1] - t[0]) + random.uniform(-0.2, 1.2) * (t[2] - t[0]);
    const bool near = random.uniform(0.0, 1.0) < 0.5;
    return beside + std::pow(10.0, random.uniform(-1.0, 1.0)) * (near ? thin : 1.0) * random.direction();
}

// A few roundings of coordinates of ten.
constexpr double kRounding = 8e-15;

} // namespace

TEST_CASE("the closest point is on the triangle, at the least distance, however narrow the triangle")
{
    VDBOUNCE_RANDOM(random);
    for (int kind = 0; kind < kKinds; ++kind) {
        double distance = 0.0;
        double off = 0.0;
        for (int i = 0; i < 6000; ++i) {
            const double thin = std::pow(10.0, random.uniform(-14.0, 0.0));
            const Triangle t = triangleOf(kind, thin, random);
            const Vec3d p = pointNear(t, thin, random);
            const Vec3d q = closestPointOnTriangle(p, t[0], t[1], t[2]);
            const Point rest = minus(exact(p), exact(q));
            distance = std::max(distance, std::abs(std::sqrt(double(dot(rest, rest))) - bruteForceDistance(p, t)));
            off = std::max(off, bruteForceDistance(q, t));
        }
        INFO("kind " << kind);
        CHECK(distance < kRounding);
        CHECK(off < kRounding);
    }
}

TEST_CASE("the closest point of a triangle that is a segment or a point is that one's")
{
    VDBOUNCE_RANDOM(random);
    for (int i = 0; i < 1000; ++i) {
        const Vec3d a = random.direction();
        const Vec3d b = random.direction();
        const Vec3d p = 3.0 * random.direction();
        const double share = std::min(1.0, std::max(0.0, (p - a).dot(b - a) / (b - a).squaredNorm()));
        const Vec3d onSegment = a + share * (b - a);
        const Vec3d middle = a + 0.25 * (b - a);
        for (const Triangle& t : {Triangle{a, b, b}, Triangle{a, a, b}, Triangle{b, a, b}, Triangle{b, middle, a}})
            CHECK((closestPointOnTriangle(p, t[0], t[1], t[2]) - onSegment).norm() < 1e-15);
        CHECK(closestPointOnTriangle(p, a, a, a) == a);
    }
}
