// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

namespace vdbounce {

/// a + b t + c t^2 + d t^3
struct Cubic {
    double a = 0.0;
    double b = 0.0;
    double c = 0.0;
    double d = 0.0;

    double at(double t) const { return ((d * t + c) * t + b) * t + a; }
};

/// The cubic along the straight way from `begin` to `end`, both places in a cell (0 to 1 an axis), of the trilinear
/// interpolation of its corners' values; corner i is at (i & 1, i >> 1 & 1, i >> 2 & 1) in x, y, z. t runs from 0 to 1.
Cubic trilinearAlong(const std::array<double, 8>& corners, const double (&begin)[3], const double (&end)[3]);

/// The last t known to be >= 0 before the cubic first becomes negative in [0, 1]: within 1e-15 of the root where it
/// starts at or above 0, and 0 where it starts below. Nothing where it stays at or above 0 throughout.
///
/// Method: between its turning points, which the quadratic formula gives, a cubic is monotone, so the sign at both
/// ends tells whether there is a root, and halving a bracket finds it (lecture, slide 15).
std::optional<double> firstBelowZero(const Cubic& cubic);

} // namespace vdbounce
