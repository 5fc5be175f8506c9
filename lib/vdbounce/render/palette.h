// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace vdbounce {

/// A colour: linear light where it is shaded, sRGB where it is written or given by hand.
using Colour = Eigen::Vector3f;

/// The colour at `t` (0 to 1) on a scale through evenly spaced colours.
template <std::size_t N> Colour onScale(const std::array<Colour, N>& scale, float t)
{
    const float at = std::clamp(t, 0.0f, 1.0f) * float(N - 1);
    const auto below = std::min(static_cast<std::size_t>(at), N - 2);
    return scale[below] + (at - float(below)) * (scale[below + 1] - scale[below]);
}

inline Colour toLinear(const Colour& srgb) { return srgb.array().pow(2.2f); }

inline std::uint8_t toByte(float srgb)
{
    return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(srgb, 0.0f, 1.0f)));
}

} // namespace vdbounce
