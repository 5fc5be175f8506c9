// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"

#include <cstdint>

namespace vdbounce {

/// What is remembered of a particle's collisions: the last one, and their number. A contact that lasts is one.
struct HitRecord {
    double time = 0.0;              ///< seconds since the scene's begin
    Vec3d position = Vec3d::Zero(); ///< of the contact, world
    Vec3d normal = Vec3d::Zero();   ///< of the collider there, outward
    Vec3d velocity = Vec3d::Zero(); ///< of the particle before
    std::int32_t collider = -1;     ///< its place in the scene; -1: none yet
    std::int32_t count = 0;
};

} // namespace vdbounce
