// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/step.h"
#include "vdbounce/contact/step_needs.h"
#include "vdbounce/contact/sweep.h"

#include <vector>

/// @file
/// One particle's step while it is worked on: what the lecture's schemes are made of. For step.cpp and the
/// headers that it includes only.

namespace vdbounce {

/// A collider that the candidate, or the way to it, touches.
struct Touch {
    bool touching = false;
    bool hasNormal = false;
    std::size_t collider = 0;
    Vec3d normal;
    Vec3d centre;       // the particle's, where it touches
    double depth = 0.0; // at the end of the path; 0 where only the way there touched
    double when = 1.0;  // share of the step
};

/// `kVariant` tells what the step may leave out, see kStepVariants.
template <int kVariant> class ParticleStep {
public:
    static constexpr StepNeeds kNeeds = kStepVariants[kVariant];

    ParticleStep(MovingParticle& particle, const PlacedColliders& colliders, const StepOptions& options,
                 StepTally& tally);

    // State, open to the schemes.
    MovingParticle& particle;
    const PlacedColliders& colliders;
    const StepOptions& options;
    StepTally& tally;
    const Vec3d start;
    Vec3d velocity; // at the start of the step, after the collisions so far
    Vec3d endVelocity;
    Vec3d candidate;
    Probe probe;             // what surrounds the candidate
    bool unresolved = false; // and counted

    /// The candidate that follows from `velocity`.
    void integrate();

    /// Whether the candidate, or the way to it, touches a collider. Updates `probe`.
    Touch look();

    /// `probe` of the candidate; true when it penetrates.
    bool penetrates();

    Probe probeAt(const Vec3d& position) const;
    bool normalAt(std::size_t collider, const Vec3d& position, Vec3d& normal) const;

    bool moves(std::size_t collider) const { return kNeeds.motion && colliders.placement(collider).moves; }
    /// It is moved by particles.
    bool isFree(std::size_t collider) const { return kNeeds.motion && colliders[collider].body; }

    Vec3d averageVelocity() const { return (candidate - start) / options.dt; }

    /// A velocity after a collision with what is touched, relative to the surface at the end of the step. The collider
    /// takes the opposite impulse.
    Vec3d collided(const Vec3d& before, const Touch& touch, double restitution);

    /// A velocity on its way from `before` to `target` by an impulse between the particle and a collider at a point:
    /// all the way, or with a collider that gives way until both have the target's velocity relative to each other. The
    /// collider takes the opposite impulse.
    Vec3d brought(const Vec3d& before, const Vec3d& target, std::size_t collider, const Vec3d& at);

    /// The average velocity of the whole step after contact, relative to how the surface is carried. No impulse: that
    /// is the end velocity's.
    Vec3d slid(const Vec3d& average, const Touch& touch, double restitution) const;

    /// Average velocity of the collider's point that is where the particle began.
    Vec3d drift(std::size_t collider) const;

    /// The particle's velocity changed by `change` through this collider, which takes, at the point `at`, the opposite
    /// impulse.
    void react(std::size_t collider, const Vec3d& at, const Vec3d& change);

    /// The point of the surface that is touched.
    Vec3d contactPoint(const Touch& touch) const;

    /// The candidate's speed must pay for the height it was moved by, where nothing that moves can have given it. False
    /// when it cannot.
    bool paysForItsHeight(std::size_t collider);

    /// Back to where it was relative to the collider, and no faster than it.
    void stop(std::size_t collider);

    /// Stops what began outside and could not be brought out again, and counts it.
    void hold(std::size_t collider);

    /// The length on which walls are told apart; planes and points of cones have none, and any will do.
    double shortLength() const;

    /// How far to move out what is `depth` inside.
    double pushOut(double depth) const;

    /// Writes position and velocity back.
    void accept();

    /// Writes the hit down where hits are asked for; the first of a contact that lasts.
    void record(const Touch& touch);

    /// Velocity of a collider's surface at the end of the step, with what this particle's impulses have changed.
    Vec3d surfaceVelocity(std::size_t collider, const Vec3d& at) const;

private:
    bool mayHaveTouchedOnTheWay() const;

    struct BodyChange {
        Vec3d linear = Vec3d::Zero();
        Vec3d angular = Vec3d::Zero();
    };

    bool swept_ = false;
    std::vector<BodyChange> bodyChanges_; // of free bodies, by this particle's impulses in this step
};

/// The lecture's schemes, for a particle that began outside and touches: they leave candidate and endVelocity resolved.
template <int kVariant> void collideContact(ParticleStep<kVariant>& step, Touch touch);
template <int kVariant> void iterate(ParticleStep<kVariant>& step, Touch touch);
template <int kVariant> void once(ParticleStep<kVariant>& step, const Touch& touch);

/// Inelastic contact over the whole step, of collideContact(), with all walls that are touched at once: what still
/// touches afterwards could not be resolved.
template <int kVariant> Touch rest(ParticleStep<kVariant>& step, Touch touch);

/// For a particle that began inside: moves it out by a share of its depth, inelastically.
template <int kVariant> void recover(ParticleStep<kVariant>& step);
/// The same by an impulse in proportion to the depth, with friction (slide 3).
template <int kVariant> void repel(ParticleStep<kVariant>& step);

/// The force within a range of the surface, on the velocity at the start of the step.
template <int kVariant> void applyRepulsion(ParticleStep<kVariant>& step);

} // namespace vdbounce
