// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"

#include <limits>

namespace vdbounce {

/// Positions are rounded each time that they are added to; a clearance gives up a few units in the last place for it.
inline double roundingOf(const Vec3d& position)
{
    return 4.0 * std::numeric_limits<double>::epsilon() * position.cwiseAbs().maxCoeff();
}

} // namespace vdbounce
