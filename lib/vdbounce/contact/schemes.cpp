// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/particle_step.h"

#include <algorithm>

/// @file
/// The lecture's numerical implementations 1 to 3.

namespace vdbounce {
namespace {

// Contact iterations a step. Curved surfaces take two or three, a wedge of two colliders ten; more is a pocket too
// narrow.
constexpr int kMaxContacts = 16;

// What a repeated bounce keeps of the restitution of the one before: the loop must lose energy to end (slide 4).
constexpr double kRepeatedBounce = 0.5;

// Elastic collisions of the velocity from the start of the step.
Touch bounce(ParticleStep& step, Touch touch)
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

// These schemes go on from the average velocity as if the particle had it at the end: the collider answers for the
// difference too, or momentum would be lost.
void answerAverage(ParticleStep& step, const Touch& touch)
{
    step.react(touch.collider, step.contactPoint(touch), step.averageVelocity() - step.endVelocity);
    step.endVelocity = step.averageVelocity();
}

} // namespace

Touch rest(ParticleStep& step, Touch touch)
{
    Vec3d average = step.averageVelocity();
    for (int i = 0; i < kMaxContacts && touch.touching && touch.hasNormal; ++i) {
        const bool approached = (average - step.drift(touch.collider)).dot(touch.normal) < 0.0;
        average = step.slid(average, touch, 0.0);
        step.endVelocity = step.collided(step.endVelocity, touch, 0.0);
        // Nothing approaches any more and still it is inside: the surface curves. Only then is it moved out.
        if (!approached || i > 0) average += step.pushOut(touch.depth) / step.options.dt * touch.normal;
        step.candidate = step.start + step.options.dt * average;
        touch = step.look();
    }
    return touch;
}

void collideContact(ParticleStep& step, Touch touch)
{
    touch = bounce(step, touch);
    const std::size_t last = touch.collider;
    touch = rest(step, touch);
    if (touch.touching || !step.paysForItsHeight(last)) step.hold(touch.touching ? touch.collider : last);
}

void iterate(ParticleStep& step, Touch touch)
{
    Vec3d average = step.averageVelocity();
    answerAverage(step, touch);
    std::size_t last = touch.collider;
    double share = 1.0;
    for (int i = 0; i < kMaxContacts && touch.touching && touch.hasNormal; ++i) {
        last = touch.collider;
        const double restitution = share * step.colliders[last].restitution;
        share *= kRepeatedBounce;
        const Vec3d before = average;
        average = step.collided(average, touch, restitution);
        Vec3d moved = average;
        if (average == before) moved += step.pushOut(touch.depth) / step.options.dt * touch.normal;
        step.candidate = step.start + step.options.dt * moved;
        step.endVelocity = average;
        average = moved;
        touch = step.look();
    }
    if (touch.touching || !step.paysForItsHeight(last)) step.hold(touch.touching ? touch.collider : last);
}

void once(ParticleStep& step, const Touch& touch)
{
    if (!touch.hasNormal) {
        step.hold(touch.collider);
        return;
    }
    const Vec3d average = step.averageVelocity();
    answerAverage(step, touch);
    step.endVelocity = step.collided(average, touch, step.colliders[touch.collider].restitution);
    step.candidate = step.start + step.options.dt * step.endVelocity;
    if (!step.paysForItsHeight(touch.collider)) step.hold(touch.collider);
    step.penetrates();
}

} // namespace vdbounce
