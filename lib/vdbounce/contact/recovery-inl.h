// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/particle_step.h"
#include "vdbounce/contact/response.h"

#include <algorithm>
#include <cmath>

/// @file
/// What keeps particles out that are in, or near: repulsion by position, by impulse and by force.

namespace vdbounce {
namespace {

// The share of its depth that a particle which began inside is moved out in one step.
constexpr double kRecovery = 0.2;

// Depth that it is moved out of at once, voxels: too little to be seen, and a share of it would never end.
constexpr double kShallowVx = 0.05;

// The share of what is left of the range that a force may move a particle in one step, so that it does not shoot out of
// it (Bridson, Fedkiw and Anderson 2002, section 7.2).
constexpr double kForceReach = 0.1;

// The way out of what `centre` penetrates, with the distance where that is known to be more than the gap.
template <int kVariant>
bool leads(const ParticleStep<kVariant>& step, std::size_t collider, const Vec3d& centre, Touch& touch)
{
    touch.touching = true;
    touch.collider = collider;
    touch.centre = centre;
    touch.hasNormal = step.colliders.wayOut(collider, centre, touch.normal, touch.depth);
    return touch.hasNormal;
}

// How far one step moves a particle out of a depth.
template <int kVariant> double outOf(const ParticleStep<kVariant>& step, double depth)
{
    return depth < kShallowVx * step.shortLength() ? step.pushOut(depth) : kRecovery * depth;
}

// An inelastic answer of the velocity from the start of the step, with the normal there.
template <int kVariant> void turnBack(ParticleStep<kVariant>& step)
{
    const Probe here = step.probeAt(step.start);
    Touch touch;
    if (!(here.gap < 0.0) || !leads(step, here.collider, step.start, touch)) return;
    step.velocity = step.collided(step.velocity, touch, 0.0);
    step.integrate();
}

} // namespace

// What still moves in is answered first, so that it cannot pass through.
template <int kVariant> void recover(ParticleStep<kVariant>& step)
{
    turnBack(step);
    if (!step.penetrates()) return;
    ++step.tally.contacts;
    Touch touch;
    if (!leads(step, step.probe.collider, step.candidate, touch)) {
        step.stop(touch.collider); // nobody knows where outside is: it must not sink deeper
    } else {
        const Vec3d average = step.slid(step.averageVelocity(), touch, 0.0);
        step.endVelocity = step.collided(step.endVelocity, touch, 0.0);
        const double depth = std::max(touch.depth, -step.probe.gap);
        step.candidate = step.start + step.options.dt * average + outOf(step, depth) * touch.normal;
    }
    step.penetrates();
}

template <int kVariant> void repel(ParticleStep<kVariant>& step)
{
    if (!step.penetrates()) return;
    ++step.tally.contacts;
    Touch touch;
    if (!leads(step, step.probe.collider, step.candidate, touch)) {
        step.stop(touch.collider);
        step.penetrates();
        return;
    }
    const std::size_t collider = touch.collider;
    const double depth = std::max(touch.depth, -step.probe.gap);
    const Vec3d surface = step.colliders.surfaceVelocity(collider, step.contactPoint(touch));
    const Vec3d w = step.averageVelocity() - surface;
    // Per mass: what carries it out, and first what still carries it in.
    const double impulse = outOf(step, depth) / step.options.dt + std::max(0.0, -w.dot(touch.normal));
    const Vec3d target = surface + pushed(w, touch.normal, impulse, step.colliders[collider].friction);
    step.endVelocity = step.brought(step.endVelocity, target, collider, step.contactPoint(touch));
    step.candidate = step.start + step.options.dt * step.endVelocity;
    step.penetrates();
}

template <int kVariant> void applyRepulsion(ParticleStep<kVariant>& step)
{
    const Repulsion& repulsion = step.options.repulsion;
    const double dt = step.options.dt;
    const Probe here = step.probeAt(step.start);
    const double overlap = repulsion.range - here.gap;
    if (!(overlap > 0.0) || !std::isfinite(here.gap)) return;
    Touch touch;
    if (here.gap < 0.0 || !leads(step, here.collider, step.start, touch)) return;
    const Vec3d surface = step.colliders.surfaceVelocity(here.collider, step.contactPoint(touch));
    const Vec3d w = step.velocity - surface;
    const double force = dt * repulsion.strength * overlap / repulsion.range;
    const double impulse = std::min(force, std::max(0.0, kForceReach * overlap / dt - w.dot(touch.normal)));
    if (!(impulse > 0.0)) return;
    const Vec3d target = surface + pushed(w, touch.normal, impulse, step.colliders[here.collider].friction);
    step.velocity = step.brought(step.velocity, target, here.collider, step.contactPoint(touch));
    step.integrate();
}

} // namespace vdbounce
