// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/particle_step.h"
#include "vdbounce/contact/response.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vdbounce {
namespace {

// What contact moves out beyond the surface, as a share of the depth: closes in from inside geometrically otherwise.
constexpr double kPushMargin = 1e-3;

// The least that a push moves a particle, as a share of the length on which walls are told apart: a thousandth of what
// trilinear interpolation can resolve.
constexpr double kSmallestPush = 1e-6;

} // namespace

template <int kVariant>
ParticleStep<kVariant>::ParticleStep(MovingParticle& p, const PlacedColliders& c, const StepOptions& o, StepTally& t)
    : particle(p), colliders(c), options(o), tally(t), start(p.position), velocity(p.velocity)
{
    integrate();
}

template <int kVariant> void ParticleStep<kVariant>::integrate()
{
    endVelocity = velocity + options.dt * options.gravity;
    candidate = start + options.dt * 0.5 * (velocity + endVelocity);
}

template <int kVariant> void ParticleStep<kVariant>::accept()
{
    particle.position = candidate;
    particle.velocity = endVelocity;
}

template <int kVariant> bool ParticleStep<kVariant>::penetrates()
{
    probe = probeAt(candidate);
    return probe.gap < 0.0;
}

template <int kVariant> Probe ParticleStep<kVariant>::probeAt(const Vec3d& position) const
{
    if constexpr (kNeeds.motion || kNeeds.several) return colliders.probe(position, particle.radius);
    const Nearness near = nearnessOf(colliders[0].shape, position, particle.radius, 0.0);
    return {near.phi - particle.radius, near.clearance, 0};
}

template <int kVariant>
bool ParticleStep<kVariant>::normalAt(std::size_t collider, const Vec3d& position, Vec3d& normal) const
{
    if constexpr (kNeeds.motion) return colliders.normalAt(collider, position, normal);
    return outwardNormal(colliders[collider].shape, position, 0.0, normal);
}

template <int kVariant> Touch ParticleStep<kVariant>::look()
{
    penetrates();
    Touch touch;
    touch.depth = std::max(0.0, -probe.gap);
    if (mayHaveTouchedOnTheWay()) {
        if (!swept_) ++tally.swept;
        swept_ = true;
        const PathHit hit = sweepPath(colliders, start, candidate, particle.radius, options.sweep);
        if (hit.hit) {
            touch.touching = true;
            touch.collider = hit.collider;
            touch.centre = hit.position;
            touch.normal = hit.normal;
            touch.hasNormal = hit.hasNormal;
            touch.when = hit.when;
            return touch;
        }
    }
    touch.touching = probe.gap < 0.0;
    touch.collider = probe.collider;
    touch.centre = candidate;
    if (touch.touching) touch.hasNormal = normalAt(probe.collider, candidate, touch.normal);
    return touch;
}

template <int kVariant> bool ParticleStep<kVariant>::mayHaveTouchedOnTheWay() const
{
    const double way = (candidate - start).norm() + (kNeeds.motion ? colliders.reach() : 0.0);
    return sweepIsDue(options.sweep, way, particle.clearance + probe.clearance, colliders.wallLength());
}

template <int kVariant> double ParticleStep<kVariant>::shortLength() const
{
    const double length = colliders.wallLength();
    const bool known = length > 0.0 && length < std::numeric_limits<double>::infinity();
    return known ? length : 0.25 * (candidate - start).norm();
}

template <int kVariant> double ParticleStep<kVariant>::pushOut(double depth) const
{
    return std::max((1.0 + kPushMargin) * depth, kSmallestPush * shortLength());
}

template <int kVariant> Vec3d ParticleStep<kVariant>::contactPoint(const Touch& touch) const
{
    return touch.hasNormal ? Vec3d(touch.centre - particle.radius * touch.normal) : touch.centre;
}

template <int kVariant> Vec3d ParticleStep<kVariant>::surfaceVelocity(std::size_t collider, const Vec3d& at) const
{
    if constexpr (!kNeeds.motion) return Vec3d::Zero();
    Vec3d surface = colliders.surfaceVelocity(collider, at);
    if (bodyChanges_.empty()) return surface;
    const BodyChange& change = bodyChanges_[collider];
    return surface + change.linear + change.angular.cross(at - colliders.placement(collider).body.centre);
}

template <int kVariant>
Vec3d ParticleStep<kVariant>::collided(const Vec3d& before, const Touch& touch, double restitution)
{
    const Collider& collider = colliders[touch.collider];
    const Vec3d at = contactPoint(touch);
    const double friction = kNeeds.friction ? collider.friction : 0.0;
    // The surface's velocity is that of the end of the step, so it is asked for where the point that was hit is then.
    const Vec3d atEnd = moves(touch.collider) ? colliders.placement(touch.collider).atEnd(at, touch.when) : at;
    Vec3d after;
    if (isFree(touch.collider)) {
        const Mat3d response =
            Mat3d::Identity() / particle.mass + colliders.placement(touch.collider).body.response(at);
        const Vec3d w = before - surfaceVelocity(touch.collider, atEnd);
        after = before + impulseBetween(w, touch.normal, restitution, friction, response) / particle.mass;
    } else if (moves(touch.collider)) {
        const Vec3d surface = surfaceVelocity(touch.collider, atEnd);
        after = respond(before - surface, touch.normal, restitution, friction) + surface;
    } else {
        after = respond(before, touch.normal, restitution, friction);
    }
    react(touch.collider, at, after - before);
    return after;
}

template <int kVariant>
Vec3d ParticleStep<kVariant>::brought(const Vec3d& before, const Vec3d& target, std::size_t collider, const Vec3d& at)
{
    Vec3d change = target - before;
    if (isFree(collider)) {
        const Mat3d response = Mat3d::Identity() / particle.mass + colliders.placement(collider).body.response(at);
        change = response.ldlt().solve(change) / particle.mass;
    }
    react(collider, at, change);
    return before + change;
}

template <int kVariant> Vec3d ParticleStep<kVariant>::drift(std::size_t collider) const
{
    if (!moves(collider)) return Vec3d::Zero();
    return (colliders.carried(collider, start) - start) / options.dt;
}

template <int kVariant>
Vec3d ParticleStep<kVariant>::slid(const Vec3d& average, const Touch& touch, double restitution) const
{
    const double friction = kNeeds.friction ? colliders[touch.collider].friction : 0.0;
    if (!moves(touch.collider)) return respond(average, touch.normal, restitution, friction);
    const Vec3d surface = drift(touch.collider);
    return respond(average - surface, touch.normal, restitution, friction) + surface;
}

template <int kVariant> void ParticleStep<kVariant>::react(std::size_t collider, const Vec3d& at, const Vec3d& change)
{
    const Vec3d impulse = -particle.mass * change;
    tally.impulse[collider] += impulse;
    tally.angularImpulse[collider] += at.cross(impulse);
    if (!isFree(collider)) return;
    if (bodyChanges_.empty()) bodyChanges_.resize(colliders.size());
    const BodyShare& body = colliders.placement(collider).body;
    bodyChanges_[collider].linear += body.inverseMass * impulse;
    bodyChanges_[collider].angular += body.inverseInertia * (at - body.centre).cross(impulse);
}

template <int kVariant> bool ParticleStep<kVariant>::paysForItsHeight(std::size_t collider)
{
    if (kNeeds.motion && !colliders.set().still()) return true;
    const double speed2 = endVelocity.squaredNorm();
    const double allowed2 = particle.velocity.squaredNorm() + 2.0 * options.gravity.dot(candidate - start);
    if (speed2 <= allowed2) return true;
    if (allowed2 < 0.0) return false;
    const Vec3d before = endVelocity;
    endVelocity *= std::sqrt(allowed2 / speed2);
    react(collider, candidate, endVelocity - before);
    return true;
}

template <int kVariant> void ParticleStep<kVariant>::stop(std::size_t collider)
{
    candidate = moves(collider) ? colliders.carried(collider, start) : start;
    endVelocity = brought(endVelocity, surfaceVelocity(collider, candidate), collider, candidate);
}

template <int kVariant> void ParticleStep<kVariant>::hold(std::size_t collider)
{
    stop(collider);
    penetrates();
    ++tally.unresolved;
    unresolved = true;
}

template <int kVariant> void ParticleStep<kVariant>::record(const Touch& touch)
{
    if (!kNeeds.hits || particle.hits == nullptr || particle.touching) return;
    HitRecord& hit = *particle.hits;
    hit.time = colliders.begin() + touch.when * options.dt;
    hit.position = contactPoint(touch);
    hit.normal = touch.hasNormal ? touch.normal : Vec3d(Vec3d::Zero());
    hit.velocity = particle.velocity + touch.when * options.dt * options.gravity;
    hit.collider = static_cast<std::int32_t>(touch.collider);
    ++hit.count;
}

} // namespace vdbounce
