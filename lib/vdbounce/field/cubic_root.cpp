// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/cubic_root.h"

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

// Halvings of [0, 1]: down to the spacing of doubles below 1.
constexpr int kHalvings = 53;

// Where the derivative b + 2 c t + 3 d t^2 is 0, within (0, 1) and in order.
int turningPoints(const Cubic& cubic, double (&points)[2])
{
    const double a = 3.0 * cubic.d;
    const double halfB = cubic.c;
    const double c = cubic.b;
    const double discriminant = halfB * halfB - a * c;
    if (!(discriminant >= 0.0)) return 0;
    // The form that does not subtract nearly equal numbers.
    const double q = -(halfB + std::copysign(std::sqrt(discriminant), halfB));
    double roots[2] = {q / a, c / q};
    if (roots[0] > roots[1]) std::swap(roots[0], roots[1]);
    int count = 0;
    for (const double root : roots) {
        if (root > 0.0 && root < 1.0) points[count++] = root; // NaN and infinity are neither
    }
    return count;
}

double lastNotBelow(const Cubic& cubic, double above, double below)
{
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (above + below);
        if (middle <= above || middle >= below) break;
        (cubic.at(middle) < 0.0 ? below : above) = middle;
    }
    return above;
}

} // namespace

Cubic trilinearAlong(const std::array<double, 8>& corners, const double (&begin)[3], const double (&end)[3])
{
    // One axis at a time: the value along the way is lower + (upper - lower) (x + t dx), a polynomial one degree
    // higher.
    const double dx = end[0] - begin[0];
    const double dy = end[1] - begin[1];
    const double dz = end[2] - begin[2];
    double a[4];
    double b[4];
    for (int i = 0; i < 4; ++i) {
        const double rise = corners[2 * i + 1] - corners[2 * i];
        a[i] = corners[2 * i] + rise * begin[0];
        b[i] = rise * dx;
    }
    double a2[2];
    double b2[2];
    double c2[2];
    for (int i = 0; i < 2; ++i) {
        const double riseA = a[2 * i + 1] - a[2 * i];
        const double riseB = b[2 * i + 1] - b[2 * i];
        a2[i] = a[2 * i] + riseA * begin[1];
        b2[i] = b[2 * i] + riseB * begin[1] + riseA * dy;
        c2[i] = riseB * dy;
    }
    const double riseA = a2[1] - a2[0];
    const double riseB = b2[1] - b2[0];
    const double riseC = c2[1] - c2[0];
    return {a2[0] + riseA * begin[2], b2[0] + riseB * begin[2] + riseA * dz, c2[0] + riseC * begin[2] + riseB * dz,
            riseC * dz};
}

std::optional<double> firstBelowZero(const Cubic& cubic)
{
    if (cubic.a < 0.0) return 0.0;
    double points[3];
    double turning[2];
    const int count = turningPoints(cubic, turning);
    std::copy(turning, turning + count, points);
    points[count] = 1.0;
    double from = 0.0;
    for (int i = 0; i <= count; ++i) {
        if (cubic.at(points[i]) < 0.0) return lastNotBelow(cubic, from, points[i]);
        from = points[i];
    }
    return std::nullopt;
}

} // namespace vdbounce
