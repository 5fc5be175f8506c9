// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/step.h"

namespace vdbounce::test {

/// A particle that is ready for its first step.
inline MovingParticle placed(const Vec3d& position, const Vec3d& velocity, const PlacedColliders& colliders,
                             double radius = 0.0)
{
    MovingParticle particle;
    particle.position = position;
    particle.velocity = velocity;
    particle.radius = radius;
    settle(particle, colliders);
    return particle;
}

/// Of a unit of mass: kinetic, and potential above the origin.
inline double energy(const MovingParticle& p, const Vec3d& gravity)
{
    return 0.5 * p.velocity.squaredNorm() - gravity.dot(p.position);
}

} // namespace vdbounce::test
