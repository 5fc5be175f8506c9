// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/base/triangle_distance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

// Height over length, squared, below which a triangle's Voronoi regions lose digits: theirs are differences of products
// as large as the length, while what is left of them goes with the height.
constexpr double kSliver = 1e-4;

// Squared sine of the angle at a below which what is given at the corners is told by the longest edge alone.
constexpr double kFlat = 1e-6;

// start + t (end - start) for the t in [0, 1] closest to p.
Vec3d closestOnSegment(const Vec3d& p, const Vec3d& start, const Vec3d& end)
{
    const Vec3d along = end - start;
    const double length2 = along.squaredNorm();
    if (length2 <= 0.0) return start;
    return start + std::min(1.0, std::max(0.0, (p - start).dot(along) / length2)) * along;
}

Vec3d closestOnEdges(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c)
{
    const Vec3d candidates[3] = {closestOnSegment(p, a, b), closestOnSegment(p, b, c), closestOnSegment(p, c, a)};
    const Vec3d* best = &candidates[0];
    for (const Vec3d& candidate : candidates) {
        if ((candidate - p).squaredNorm() < (*best - p).squaredNorm()) best = &candidate;
    }
    return *best;
}

// In the triangle's own frame, its longest edge along x: rounding then moves its corners by no more than it would move
// p.
Vec3d closestOnSliver(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c)
{
    const double bc2 = (c - b).squaredNorm();
    const double ca2 = (a - c).squaredNorm();
    const double ab2 = (b - a).squaredNorm();
    if (bc2 > ab2 && bc2 >= ca2) return closestOnSliver(p, b, c, a);
    if (ca2 > ab2) return closestOnSliver(p, c, a, b);
    const double length = std::sqrt(ab2);
    if (!(length > 0.0)) return a;
    const Vec3d along = (b - a) / length;
    const Vec3d toTip = c - a;
    const double tip = toTip.dot(along);
    Vec3d up = toTip - tip * along;
    up -= up.dot(along) * along; // of what the first time left, rounding is a large part
    const double height = up.norm();
    if (!(height > 0.0)) return closestOnEdges(p, a, b, c);
    up /= height;
    const double x = (p - a).dot(along);
    const double y = (p - a).dot(up);
    const bool within = y >= 0.0 && y * tip <= x * height && y * (length - tip) <= (length - x) * height;
    return within ? a + x * along + y * up : closestOnEdges(p, a, b, c);
}

} // namespace

Vec3d closestPointOnTriangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c)
{
    const Vec3d ab = b - a;
    const Vec3d ac = c - a;
    const Vec3d ap = p - a;
    const double d1 = ab.dot(ap);
    const double d2 = ac.dot(ap);
    if (d1 <= 0.0 && d2 <= 0.0) return a;

    const Vec3d bp = p - b;
    const double d3 = ab.dot(bp);
    const double d4 = ac.dot(bp);
    if (d3 >= 0.0 && d4 <= d3) return b;

    const Vec3d cp = p - c;
    const double d5 = ab.dot(cp);
    const double d6 = ac.dot(cp);
    if (d6 >= 0.0 && d5 <= d6) return c;

    const double ab2 = ab.squaredNorm();
    const double ac2 = ac.squaredNorm();
    const double both = ab.dot(ac);
    const double longest2 = std::max(std::max(ab2, ac2), ab2 + ac2 - 2.0 * both);
    if (!(ab2 * ac2 - both * both > kSliver * longest2 * longest2)) return closestOnSliver(p, a, b, c);

    const double va = d3 * d6 - d5 * d4;
    const double vb = d5 * d2 - d1 * d6;
    const double vc = d1 * d4 - d3 * d2;
    const double area2 = va + vb + vc; // |ab x ac|^2
    if (!(area2 > 0.0) || va <= 0.0 || vb <= 0.0 || vc <= 0.0) return closestOnEdges(p, a, b, c);
    return a + ab * (vb / area2) + ac * (vc / area2);
}

Vec3d closestWeights(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c)
{
    const Vec3d at = closestPointOnTriangle(p, a, b, c);
    const Vec3d normal = (b - a).cross(c - a);
    if (normal.squaredNorm() > kFlat * (b - a).squaredNorm() * (c - a).squaredNorm()) {
        const double weightB = (at - a).cross(c - a).dot(normal) / normal.squaredNorm();
        const double weightC = (b - a).cross(at - a).dot(normal) / normal.squaredNorm();
        return Vec3d(1.0 - weightB - weightC, weightB, weightC);
    }
    const Vec3d* corners[3] = {&a, &b, &c};
    int longest = 0;
    double length2 = 0.0;
    for (int edge = 0; edge < 3; ++edge) {
        const double edge2 = (*corners[(edge + 1) % 3] - *corners[edge]).squaredNorm();
        if (edge2 > length2) longest = edge;
        length2 = std::max(length2, edge2);
    }
    Vec3d weights = Vec3d::Unit(longest);
    if (!(length2 > 0.0)) return weights;
    const int other = (longest + 1) % 3;
    const Vec3d along = *corners[other] - *corners[longest];
    const double share = std::min(1.0, std::max(0.0, (at - *corners[longest]).dot(along) / length2));
    weights[longest] = 1.0 - share;
    weights[other] = share;
    return weights;
}

double windingContribution(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c)
{
    const Vec3d u = a - p;
    const Vec3d v = b - p;
    const Vec3d w = c - p;
    const double lu = u.norm();
    const double lv = v.norm();
    const double lw = w.norm();
    const double numerator = u.dot(v.cross(w));
    const double denominator = lu * lv * lw + u.dot(v) * lw + v.dot(w) * lu + w.dot(u) * lv;
    return std::atan2(numerator, denominator) / (2.0 * M_PI);
}

} // namespace vdbounce
