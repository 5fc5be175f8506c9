// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/collider.h"
#include "vdbounce/contact/step_tally.h"

namespace vdbounce {

/// When to look for collisions along a particle's path and not only at its end.
enum class Sweep {
    Auto,   ///< where the step is longer than a voxel and may have touched something on the way
    Always, ///< where the step may have touched something on the way
    Never,
};

struct StepOptions {
    double dt = 0.004;                      ///< seconds, > 0
    Vec3d gravity = Vec3d(0.0, -9.81, 0.0); ///< world units / s^2
    int maxBounces = 3;                     ///< elastic collisions a step, >= 0
    Sweep sweep = Sweep::Auto;
};

/// A particle while it is being stepped.
struct MovingParticle {
    Vec3d position;
    Vec3d velocity;
    double radius = 0.0;
    double mass = 1.0;
    /// Lower bound on how far it can move without touching anything, shrunk by every step's way; while it is
    /// longer than the step, no collider is looked at.
    double clearance = 0.0;
    bool inside = false; ///< it penetrates a collider
};

/// Finds out what surrounds a particle; needed before its first step.
void settle(MovingParticle& particle, const ColliderSet& colliders);

/// Advances one particle by one step with the lecture's third scheme, collide-contact (slide 8):
///
/// 1. The candidate: v* = v + dt g, x* = x + dt (v + v*) / 2.
/// 2. While x* penetrates and the velocity v from the start of the step approaches, up to maxBounces times: an elastic
///    collision of v, and a new candidate from it.
/// 3. While x* still penetrates: inelastic contact. The average velocity (x* - x) / dt is answered with restitution 0
/// and
///    moves the particle, x* = x + dt v_average; the end velocity v* is answered the same way. What is then left
///    inside, as on a curved surface, is moved out along the normal.
///
/// To a particle outside colliders at rest never add energy: what being moved out gains in height is taken from the
/// speed. A particle that starts outside ends outside: one that cannot be resolved stays where it was, at rest, and is
/// counted. One that starts inside is answered inelastically and moved out in proportion to its depth.
/// Resting particles have v = 0 at the start of the step, so step 2 leaves them alone and step 3 keeps them exactly in
/// place.
void step(MovingParticle& particle, const ColliderSet& colliders, const StepOptions& options, StepTally& tally);

} // namespace vdbounce
