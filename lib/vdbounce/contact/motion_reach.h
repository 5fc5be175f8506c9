// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/pose.h"
#include "vdbounce/contact/shape.h"

namespace vdbounce {

/// The farthest that any point of a ball moves on a rigid way from one pose to the other in `dt` seconds, world units;
/// `velocity` is that at the end. `ball` is where the poses move it from.
double motionReach(const Pose& begin, const Pose& end, const RigidVelocity& velocity, const BoundingBall& ball,
                   double dt);

} // namespace vdbounce
