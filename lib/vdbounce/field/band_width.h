// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>

namespace vdbounce {

/// A band's width as a grid has it: rounded up to float, for OpenVDB's checks ask for no less than was meant.
inline float bandWidth(double world)
{
    const float nearest = float(world);
    return double(nearest) < world ? std::nextafter(nearest, std::numeric_limits<float>::infinity()) : nearest;
}

} // namespace vdbounce
