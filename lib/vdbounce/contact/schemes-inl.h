// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/particle_step.h"
#include "vdbounce/contact/walls.h"

#include <algorithm>
#include <array>

/// @file
/// The lecture's numerical implementations 1 to 3.

namespace vdbounce {
namespace {

// Contact iterations a step. Curved surfaces and wedges take two or three; more is a pocket too narrow.
constexpr int kMaxContacts = 16;

// What a repeated bounce keeps of the restitution of the one before: the loop must lose energy to end (slide 4).
constexpr double kRepeatedBounce = 0.5;

// Elastic collisions of the velocity from the start of the step.
template <int kVariant> Touch bounce(ParticleStep<kVariant>& step, Touch touch)
{
    for (int i = 0; i < step.options.maxBounces && touch.touching && touch.hasNormal; ++i) {
        const Vec3d before = step.velocity;
        step.velocity = step.collided(before, touch, step.colliders[touch.collider].restitution);
        if (step.velocity == before) break; // it does not approach
        step.integrate();
        touch = step.look();
    }
    return touch;
}

// The average velocity against all walls at once, leaving the last of them by at least `leave`.
template <int kVariant>
void slideAlong(ParticleStep<kVariant>& step, Walls& walls, int last, double leave, Vec3d& average)
{
    for (int i = 0; i < walls.count(); ++i) {
        walls[i].velocity = step.drift(walls[i].collider);
        walls[i].leave = i == last ? leave : 0.0;
    }
    std::array<Vec3d, Walls::kMost> changes;
    if (walls.answer(average, changes)) return;
    // Between parallel walls: against the last of them at least.
    const double missing = leave - (average - walls[last].velocity).dot(walls[last].normal);
    average += std::max(0.0, missing) * walls[last].normal;
}

// Against colliders that give way, and do so differently in each direction.
template <int kVariant> void stopOneAfterTheOther(ParticleStep<kVariant>& step, const Walls& walls, Touch touch)
{
    for (int i = 0; i < kMaxContacts * walls.count(); ++i) {
        const Walls::Wall& wall = walls[i % walls.count()];
        touch.collider = wall.collider;
        touch.normal = wall.normal;
        step.endVelocity = step.collided(step.endVelocity, touch, 0.0);
    }
}

// The same of the end velocity, whose changes the colliders take.
template <int kVariant> void stopAgainst(ParticleStep<kVariant>& step, Walls& walls, const Touch& touch)
{
    const Vec3d at = step.contactPoint(touch);
    if (step.kNeeds.motion && step.colliders.set().anyFree()) {
        stopOneAfterTheOther(step, walls, touch);
        return;
    }
    for (int i = 0; i < walls.count(); ++i) {
        walls[i].velocity = step.surfaceVelocity(walls[i].collider, at);
        walls[i].leave = 0.0;
    }
    std::array<Vec3d, Walls::kMost> changes;
    if (!walls.answer(step.endVelocity, changes)) {
        step.endVelocity = step.collided(step.endVelocity, touch, 0.0);
        return;
    }
    for (int i = 0; i < walls.count(); ++i) step.react(walls[i].collider, at, changes[std::size_t(i)]);
}

// These schemes go on from the average velocity as if the particle had it at the end: the collider answers for the
// difference too, or momentum would be lost. One that gives way cannot: it is answered with the end velocity.
template <int kVariant> void answerAverage(ParticleStep<kVariant>& step, const Touch& touch)
{
    if (step.isFree(touch.collider)) return;
    step.react(touch.collider, step.contactPoint(touch), step.averageVelocity() - step.endVelocity);
    step.endVelocity = step.averageVelocity();
}

// Undoes responses: the collider gives back what it took.
template <int kVariant> void goBack(ParticleStep<kVariant>& step, const Touch& touch, const Vec3d& average)
{
    step.react(touch.collider, step.contactPoint(touch), average - step.endVelocity);
    step.endVelocity = average;
    step.candidate = step.start + step.options.dt * average;
}

// Responses of the average velocity until it is outside, the first with `share` of the restitution. What moves it out
// of a curved surface is no velocity: nobody gave it.
template <int kVariant>
Touch bounceRepeatedly(ParticleStep<kVariant>& step, Touch touch, double share, std::size_t& last)
{
    Vec3d push = Vec3d::Zero();
    for (int i = 0; i < kMaxContacts && touch.touching && touch.hasNormal; ++i) {
        last = touch.collider;
        const Vec3d before = step.endVelocity;
        step.endVelocity = step.collided(before, touch, share * step.colliders[last].restitution);
        share *= kRepeatedBounce;
        if (step.endVelocity == before) push += step.pushOut(touch.depth) * touch.normal;
        step.candidate = step.start + step.options.dt * step.endVelocity + push;
        touch = step.look();
    }
    return touch;
}

} // namespace

template <int kVariant> Touch rest(ParticleStep<kVariant>& step, Touch touch)
{
    Vec3d average = step.averageVelocity();
    Walls walls;
    for (int i = 0; i < kMaxContacts && touch.touching && touch.hasNormal; ++i) {
        bool known = false;
        const int wall = walls.add(touch.normal, touch.collider, step.colliders[touch.collider].friction, known);
        const double leaving = (average - step.drift(touch.collider)).dot(touch.normal);
        // Nothing approaches any more and still it is inside, or again: the surface curves. Only then is it moved out.
        const bool push = !(leaving < 0.0) || known;
        const double out = push ? step.pushOut(touch.depth) / step.options.dt : 0.0;
        if (walls.count() == 1) {
            average = step.slid(average, touch, 0.0) + out * touch.normal;
            step.endVelocity = step.collided(step.endVelocity, touch, 0.0);
        } else {
            slideAlong(step, walls, wall, push ? std::max(0.0, leaving) + out : 0.0, average);
            stopAgainst(step, walls, touch);
        }
        step.candidate = step.start + step.options.dt * average;
        touch = step.look();
    }
    return touch;
}

template <int kVariant> void collideContact(ParticleStep<kVariant>& step, Touch touch)
{
    touch = bounce(step, touch);
    const std::size_t last = touch.collider;
    touch = rest(step, touch);
    if (touch.touching || !step.paysForItsHeight(last)) step.hold(touch.touching ? touch.collider : last);
}

template <int kVariant> void iterate(ParticleStep<kVariant>& step, Touch touch)
{
    const Touch first = touch;
    answerAverage(step, touch);
    const Vec3d before = step.endVelocity;
    std::size_t last = touch.collider;
    // A bounce may lift it by more than its speed pays for: then without one.
    for (const double start : {1.0, 0.0}) {
        touch = bounceRepeatedly(step, first, start, last);
        if (!touch.touching && step.paysForItsHeight(last)) return;
        goBack(step, first, before);
    }
    step.hold(touch.touching ? touch.collider : last);
}

template <int kVariant> void once(ParticleStep<kVariant>& step, const Touch& touch)
{
    answerAverage(step, touch);
    const Vec3d before = step.endVelocity;
    for (const double share : {1.0, 0.0}) {
        if (!touch.hasNormal) break;
        step.endVelocity = step.collided(before, touch, share * step.colliders[touch.collider].restitution);
        step.candidate = step.start + step.options.dt * step.endVelocity;
        if (step.paysForItsHeight(touch.collider)) {
            step.penetrates();
            return;
        }
        goBack(step, touch, before);
    }
    step.hold(touch.collider);
}

} // namespace vdbounce
