// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

/// @file
/// Set operations on solids that are given by a function, negative inside: the lecture's min and max (slides 17 and
/// 27), and smooth ones that round the edge where the two surfaces meet.

namespace vdbounce {

enum class CsgOperation {
    Union,        ///< in a or in b: min(a, b)
    Intersection, ///< in a and in b: max(a, b)
    Subtraction,  ///< in a and not in b: max(a, -b)
    Complement,   ///< not in a: -a; b counts for nothing
};

/// The smaller of two numbers with the kink between them rounded off: min(a, b) to the bit where they are `blend` or
/// further apart or `blend` is 0, nowhere more than blend / 4 below it. The derivatives along a and b are continuous,
/// not negative and add up to 1, so that a result of 1-Lipschitz functions is 1-Lipschitz. Symmetric to the bit.
/// Method: the quadratic polynomial smooth minimum of I. Quilez, "Smooth minimum" (2013).
template <class Real> Real smoothMinimum(Real a, Real b, Real blend)
{
    const Real least = std::min(a, b);
    const Real apart = std::abs(a - b);
    if (!(apart < blend)) return least; // also where both are the same infinity
    const Real depth = blend - apart;
    return least - depth * depth / (Real(4) * blend);
}

/// What `operation` makes of the values a and b of two functions at a place. `blend` >= 0 in units of the values: how
/// far apart they are at most where an edge is rounded; 0 leaves edges as they are.
inline double combine(CsgOperation operation, double a, double b, double blend = 0.0)
{
    switch (operation) {
    case CsgOperation::Union: return smoothMinimum(a, b, blend);
    case CsgOperation::Intersection: return -smoothMinimum(-a, -b, blend);
    case CsgOperation::Subtraction: return -smoothMinimum(-a, b, blend);
    case CsgOperation::Complement: break;
    }
    return -a;
}

/// The derivatives of combine() along a and b, each in [-1, 1]: gradients add up with them. Their absolute values add
/// up to 1 and are the shares with which what belongs to a surface (its velocity, its friction) adds up.
struct CsgWeights {
    double a;
    double b;
};

/// The weights at values a and b. Where neither is nearer and nothing is blended, a's surface has it all.
inline CsgWeights combinationWeights(CsgOperation operation, double a, double b, double blend = 0.0)
{
    if (operation == CsgOperation::Complement) return {-1.0, 0.0};
    // Of the minimum that the operation comes to: of a and b, -a and -b, or -a and b.
    const double first = operation == CsgOperation::Union ? a : -a;
    const double second = operation == CsgOperation::Intersection ? -b : b;
    const double apart = std::abs(first - second);
    const double shareOfLarger = apart < blend ? 0.5 * (blend - apart) / blend : 0.0;
    const double shareOfA = first <= second ? 1.0 - shareOfLarger : shareOfLarger;
    const double shareOfB = 1.0 - shareOfA;
    return {shareOfA, operation == CsgOperation::Subtraction ? -shareOfB : shareOfB};
}

} // namespace vdbounce
