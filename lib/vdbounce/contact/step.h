// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/free_flight.h"
#include "vdbounce/contact/placed_colliders.h"
#include "vdbounce/contact/step_tally.h"
#include "vdbounce/contact/sweep.h"
#include "vdbounce/particles/hit_record.h"

namespace vdbounce {

/// How a particle that penetrates at the end of a step is answered: the lecture's three numerical implementations.
enum class Scheme {
    Once,           ///< one response; what then penetrates another collider is left to the next step (slide 2)
    Iterate,        ///< responses until it is outside, each after the first losing energy (slide 5)
    CollideContact, ///< elastic collisions of the velocity before the step, then inelastic contact (slide 8)
};

/// What scenes and reports call them, in the enumeration's order.
constexpr const char* kSchemeNames[] = {"once", "iterate", "collide-contact"};
inline const char* nameOf(Scheme scheme) { return kSchemeNames[int(scheme)]; }

/// A force that keeps particles away from surfaces: within `range` of touching, an acceleration outward that grows
/// linearly from 0 at `range` to `strength` at the surface (slide 20). Coulomb friction as for contact.
struct Repulsion {
    double range = 0.0;    ///< world units, >= 0; 0 is none
    double strength = 0.0; ///< world units / s^2, >= 0
};

struct StepOptions {
    double dt = 0.004;                      ///< seconds, > 0
    Vec3d gravity = Vec3d(0.0, -9.81, 0.0); ///< world units / s^2
    Scheme scheme = Scheme::CollideContact;
    int maxBounces = 3; ///< elastic collisions a step, >= 0; of CollideContact
    Sweep sweep = Sweep::Auto;
    Repulsion repulsion;
};

/// A particle while it is being stepped.
struct MovingParticle {
    Vec3d position;
    Vec3d velocity;
    double radius = 0.0;
    double mass = 1.0;
    /// Lower bound on how far it can move without touching anything, shrunk by every step's way and by what colliders
    /// move; while it is longer than the step, no collider is looked at.
    double clearance = 0.0;
    bool inside = false;       ///< it penetrates a collider
    bool touching = false;     ///< it touched one in the last step
    bool deleted = false;      ///< it touched one that deletes; no more steps
    int stuckTo = kNotStuck;   ///< the collider that it moves along with
    HitRecord* hits = nullptr; ///< where to write hits; null: nowhere

    static constexpr int kNotStuck = -1;
};

/// What free flight needs of the options; reach and steps are left to the caller.
FlightPlan flightPlan(const StepOptions& options);

/// Finds out what surrounds a particle; needed before its first step, with the colliders as they are then.
void settle(MovingParticle& particle, const PlacedColliders& colliders);

/// Advances one particle by one step, during which the colliders move as placed. The candidate is
/// v* = v + dt g, x* = x + dt (v + v*) / 2; where it, or the path to it, touches, `options.scheme` answers:
///
/// CollideContact. 1. While x* penetrates and the velocity v from the start of the step approaches, up to maxBounces
/// times: an elastic collision of v, and a new candidate from it. 2. While x* still penetrates: inelastic contact. The
/// average velocity (x* - x) / dt is answered with restitution 0 and moves the particle; the end velocity v* is
/// answered the same way. What is then left inside, as on a curved surface, is moved out along the normal. Resting
/// particles have v = 0 at the start of the step, so they keep exactly in place.
///
/// Iterate. While x* penetrates: the average velocity is answered with the collider's restitution, halved each time
/// after the first, and becomes the velocity; x* = x + dt v.
///
/// Once. The same, once.
///
/// Velocities are relative to the collider's surface: collisions at the contact and the end of the step, contact over
/// the whole step, so that what sticks moves along exactly.
///
/// With every scheme: against colliders that never move, a particle that began outside gains no energy: what being
/// moved gains in height is taken from the speed. With Iterate and CollideContact, what begins outside ends outside:
/// one that cannot be resolved stays where it was, relative to the collider, at rest, and is counted. What begins
/// inside is answered inelastically and moved out in proportion to its depth; with Once it gets the impulse that does
/// so (slide 3).
void step(MovingParticle& particle, const PlacedColliders& colliders, const StepOptions& options, StepTally& tally);

/// For a particle that others have moved to `moved`, with `velocity`, after its step from `start`: contact with the
/// colliders over the whole step once more. Where these leave no room it stays where the step had left it.
void moveAgain(MovingParticle& particle, const Vec3d& start, const Vec3d& moved, const Vec3d& velocity,
               const PlacedColliders& colliders, const StepOptions& options, StepTally& tally);

} // namespace vdbounce
