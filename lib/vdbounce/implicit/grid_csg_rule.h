// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/csg_operation.h"

#include <algorithm>
#include <limits>

/// @file
/// A set operation on the values of two narrow bands. Every operation is the minimum of two numbers with signs turned
/// before and after: max(a, b) = -min(-a, -b), max(a, -b) = -min(-a, b). What is said of "low" and "high" is about that
/// minimum.

namespace vdbounce {

/// How far from the surface a narrow band's values are known, world units: beyond, only the side is.
struct CsgBand {
    float exterior = 0.0f;                                   ///< the background
    float interior = std::numeric_limits<float>::infinity(); ///< infinite where all that is inside is known
};

/// A blended surface lies up to a quarter of the blend from both, and depends on values up to the blend above the
/// smaller one: so much of the band on the high side is lost.
constexpr float kBandLostToBlend = 1.25f;

struct CsgRule {
    float signA = 1.0f;
    float signB = 1.0f;
    float signOut = 1.0f;
    float low = 0.0f;  ///< what is as low decides the minimum, whatever the other
    float high = 0.0f; ///< what is as high leaves the minimum to the other
    float blend = 0.0f;

    /// For a union, intersection or subtraction.
    CsgRule(CsgOperation operation, const CsgBand& a, const CsgBand& b, float blendWorld) : blend(blendWorld)
    {
        const auto ends = [](const CsgBand& band, float sign) {
            return sign > 0.0f ? std::pair(band.interior, band.exterior) : std::pair(band.exterior, band.interior);
        };
        if (operation != CsgOperation::Union) signA = signOut = -1.0f;
        if (operation == CsgOperation::Intersection) signB = -1.0f;
        low = -std::min(ends(a, signA).first, ends(b, signB).first);
        high = std::min(ends(a, signA).second, ends(b, signB).second) - kBandLostToBlend * blend;
    }

    /// The band of the result.
    CsgBand band() const { return signOut > 0.0f ? CsgBand{high, -low} : CsgBand{-low, high}; }

    /// The minimum of two values whose signs are turned already, before its own is turned back. To the bit
    /// smoothMinimum(), without a branch.
    float minimum(float x, float y) const
    {
        const float least = std::min(x, y);
        const float depth = std::max(blend - std::abs(x - y), 0.0f);
        return blend > 0.0f ? least - depth * depth / (4.0f * blend) : least;
    }

    /// A minimum within the band.
    float clamped(float value) const { return std::max(low, std::min(high, value)); }
};

} // namespace vdbounce
