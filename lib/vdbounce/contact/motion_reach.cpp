// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/motion_reach.h"

#include <algorithm>
#include <cmath>

namespace vdbounce {

double motionReach(const Pose& begin, const Pose& end, const RigidVelocity& velocity, const BoundingBall& ball,
                   double dt)
{
    // The centre of motion goes straight; every point of the ball turns around it by no more than its distance allows.
    const Vec3d centre = end.toLocal(velocity.centre);
    const double straight = (end.toWorld(centre) - begin.toWorld(centre)).norm();
    // |R1 - R0| / sqrt(2) in the Frobenius norm is the chord of the turn, and its arc at most pi/2 times that; a
    // turn of more than half a circle shows in the velocity only.
    const double chord = (end.rotation - begin.rotation).norm() / std::sqrt(2.0);
    const double angle = std::max(0.5 * M_PI * chord, dt * velocity.angular.norm());
    return angle > 0.0 ? straight + angle * ((ball.centre - centre).norm() + ball.radius) : straight;
}

} // namespace vdbounce
