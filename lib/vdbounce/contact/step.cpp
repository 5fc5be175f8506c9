// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/step.h"

#include "vdbounce/contact/particle_step-inl.h"
#include "vdbounce/contact/recovery-inl.h"
#include "vdbounce/contact/schemes-inl.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace vdbounce {
namespace {

// Moves along with the collider it stuck to.
void ride(MovingParticle& particle, const PlacedColliders& colliders, const StepOptions& options, StepTally& tally)
{
    const auto collider = static_cast<std::size_t>(particle.stuckTo);
    const Vec3d before = particle.velocity + options.dt * options.gravity;
    particle.position = colliders.carried(collider, particle.position);
    particle.velocity = colliders.surfaceVelocity(collider, particle.position);
    const Vec3d impulse = -particle.mass * (particle.velocity - before);
    tally.impulse[collider] += impulse;
    tally.angularImpulse[collider] += particle.position.cross(impulse);
}

template <int kVariant> void stick(ParticleStep<kVariant>& step, const Touch& touch)
{
    const Vec3d before = step.endVelocity;
    step.particle.stuckTo = static_cast<int>(touch.collider);
    // Where it touches when it touches, and from there on with the collider.
    const Placement& placement = step.colliders.placement(touch.collider);
    step.candidate = placement.atEnd(touch.centre, touch.when);
    if (step.penetrates() && touch.hasNormal) {
        const Mat3d turn = placement.end.rotation * placement.between(touch.when).rotation.transpose();
        step.candidate -= step.probe.gap * (turn * touch.normal);
    }
    step.endVelocity = step.colliders.surfaceVelocity(touch.collider, step.candidate);
    step.react(touch.collider, touch.centre, step.endVelocity - before);
}

// Whether the collider keeps or removes what touches it.
template <int kVariant> bool takes(ParticleStep<kVariant>& step, const Touch& touch)
{
    const OnHit onHit = step.colliders[touch.collider].onHit;
    if (onHit == OnHit::Delete) step.particle.deleted = true;
    if (onHit == OnHit::Stick) stick(step, touch);
    return onHit != OnHit::Bounce;
}

template <int kVariant> void answer(ParticleStep<kVariant>& step, const Touch& touch)
{
    ++step.tally.contacts;
    step.record(touch);
    if (step.kNeeds.taking && takes(step, touch)) return;
    switch (step.options.scheme) {
    case Scheme::Once: once(step, touch); break;
    case Scheme::Iterate: iterate(step, touch); break;
    case Scheme::CollideContact: collideContact(step, touch); break;
    }
}

// For a particle that began inside.
template <int kVariant> void answerInside(ParticleStep<kVariant>& step)
{
    if (step.penetrates()) {
        Touch touch;
        touch.touching = true;
        touch.collider = step.probe.collider;
        touch.centre = step.candidate;
        step.record(touch);
        if (step.kNeeds.taking && takes(step, touch)) {
            ++step.tally.contacts;
            return;
        }
    }
    if (step.options.scheme == Scheme::Once) {
        repel(step);
    } else {
        recover(step);
    }
}

template <int kVariant> void answerNear(ParticleStep<kVariant>& step)
{
    MovingParticle& particle = step.particle;
    if (step.kNeeds.repulsion && step.options.repulsion.range > 0.0) applyRepulsion(step);
    if (particle.inside) {
        answerInside(step);
        particle.touching = true;
    } else {
        const Touch touch = step.look();
        if (touch.touching) answer(step, touch);
        particle.touching = touch.touching;
    }
    step.accept();
    particle.clearance = step.probe.clearance;
    particle.inside = step.probe.gap < 0.0;
    if (particle.inside && particle.stuckTo == MovingParticle::kNotStuck && !particle.deleted) {
        if (!step.unresolved) ++step.tally.unresolved;
        step.tally.maxPenetration = std::max(step.tally.maxPenetration, -step.probe.gap);
    }
}

template <int kVariant>
void stepAs(MovingParticle& particle, const PlacedColliders& colliders, const StepOptions& options, StepTally& tally)
{
    if (particle.deleted) return;
    if (particle.stuckTo != MovingParticle::kNotStuck) {
        ++tally.free;
        ride(particle, colliders, options, tally);
        return;
    }
    const FlightPlan plan = flightPlan(options);
    if (flyFreely(plan, colliders.reach(), particle.position, particle.velocity, particle.clearance)) {
        ++tally.free;
        particle.touching = false;
        return;
    }
    ParticleStep<kVariant> step(particle, colliders, options, tally);
    if (!std::isfinite((step.candidate - step.start).norm())) {
        // Faster than numbers go: nothing can be said about where it would be.
        ++tally.near;
        ++tally.unresolved;
        return;
    }
    ++tally.near;
    answerNear(step);
}

} // namespace

FlightPlan flightPlan(const StepOptions& options)
{
    FlightPlan plan;
    plan.speedUp = options.dt * options.gravity;
    plan.halfStep = options.dt * 0.5;
    plan.range = options.repulsion.range;
    return plan;
}

void settle(MovingParticle& particle, const PlacedColliders& colliders)
{
    const Probe probe = colliders.probe(particle.position, particle.radius);
    particle.clearance = probe.clearance;
    particle.inside = probe.gap < 0.0;
}

StepNeeds needsOf(const ColliderSet& colliders, const StepOptions& options, bool hits)
{
    StepNeeds needs;
    needs.motion = !colliders.still();
    needs.several = colliders.size() != 1;
    needs.friction = false;
    needs.taking = false;
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        needs.friction = needs.friction || colliders[i].friction != 0.0;
        needs.taking = needs.taking || colliders[i].onHit != OnHit::Bounce;
    }
    needs.repulsion = options.repulsion.range > 0.0;
    needs.hits = hits;
    return needs;
}

StepFunction stepOfVariant(int variant)
{
    static constexpr StepFunction kVariants[] = {stepAs<0>, stepAs<1>, stepAs<2>, stepAs<3>};
    static_assert(std::size(kVariants) == std::size(kStepVariants));
    return kVariants[variant];
}

void step(MovingParticle& particle, const PlacedColliders& colliders, const StepOptions& options, StepTally& tally)
{
    stepAs<kWholeStep>(particle, colliders, options, tally);
}

void moveAgain(MovingParticle& particle, const Vec3d& start, const Vec3d& moved, const Vec3d& velocity,
               const PlacedColliders& colliders, const StepOptions& options, StepTally& tally)
{
    if (particle.deleted || particle.inside || particle.stuckTo != MovingParticle::kNotStuck) return;
    const double way = (moved - particle.position).norm();
    const double rounding = kClearanceRounding * moved.cwiseAbs().maxCoeff();
    if (way + rounding < particle.clearance) {
        particle.position = moved;
        particle.velocity = velocity;
        particle.clearance -= way + rounding;
        return;
    }
    MovingParticle from = particle;
    from.position = start;
    from.clearance = 0.0; // was that of another place
    StepTally trial(colliders.size());
    ParticleStep<kWholeStep> step(from, colliders, options, trial);
    step.candidate = moved;
    step.endVelocity = velocity;
    Touch touch = step.look();
    if (touch.touching) {
        if (!particle.touching) ++trial.contacts;
        step.record(touch);
        from.touching = true;
        if (!takes(step, touch)) touch = rest(step, touch);
    }
    const bool taken = from.deleted || from.stuckTo != MovingParticle::kNotStuck;
    if (!taken && (touch.touching || step.probe.gap < 0.0)) return;
    step.accept();
    from.clearance = step.probe.clearance;
    particle = from;
    tally += trial;
}

} // namespace vdbounce
