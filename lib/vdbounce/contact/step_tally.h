// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"

#include <cstdint>
#include <vector>

namespace vdbounce {

/// What happened to the colliders and how often.
struct StepTally {
    std::uint64_t free = 0;            ///< particle steps without any lookup
    std::uint64_t near = 0;            ///< particle steps that looked a collider up
    std::uint64_t contacts = 0;        ///< of these, those with a collision or contact
    std::uint64_t swept = 0;           ///< of these, those that searched along the path
    std::uint64_t unresolved = 0;      ///< of these, those that ended where they began, or still inside
    double maxPenetration = 0.0;       ///< deepest -gap at the end of a step, world units
    std::vector<Vec3d> impulse;        ///< on each collider
    std::vector<Vec3d> angularImpulse; ///< on each collider, about the world's origin

    explicit StepTally(std::size_t colliders = 0);
    StepTally& operator+=(const StepTally& other);
};

} // namespace vdbounce
