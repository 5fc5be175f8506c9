// SPDX-License-Identifier: Apache-2.0
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

bool sweepIsDue(Sweep sweep, double way, double clear, double wallLength)
{
    return way > clear && sweepIsDue(sweep, way, wallLength);
}

ParticleStep::ParticleStep(MovingParticle& p, const PlacedColliders& c, const StepOptions& o, StepTally& t)
    : particle(p), colliders(c), options(o), tally(t), start(p.position), velocity(p.velocity)
{
    integrate();
}

void ParticleStep::integrate()
{
    endVelocity = velocity + options.dt * options.gravity;
    candidate = start + options.dt * 0.5 * (velocity + endVelocity);
}

void ParticleStep::accept()
{
    particle.position = candidate;
    particle.velocity = endVelocity;
}

bool ParticleStep::penetrates()
{
    probe = colliders.probe(candidate, particle.radius);
    return probe.gap < 0.0;
}

Touch ParticleStep::look()
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
    if (touch.touching) touch.hasNormal = colliders.normalAt(probe.collider, candidate, touch.normal);
    return touch;
}

bool ParticleStep::mayHaveTouchedOnTheWay() const
{
    const double way = (candidate - start).norm() + colliders.reach();
    return sweepIsDue(options.sweep, way, particle.clearance + probe.clearance, colliders.wallLength());
}

double ParticleStep::shortLength() const
{
    const double length = colliders.wallLength();
    const bool known = length > 0.0 && length < std::numeric_limits<double>::infinity();
    return known ? length : 0.25 * (candidate - start).norm();
}

double ParticleStep::pushOut(double depth) const
{
    return std::max((1.0 + kPushMargin) * depth, kSmallestPush * shortLength());
}

Vec3d ParticleStep::contactPoint(const Touch& touch) const
{
    return touch.hasNormal ? Vec3d(touch.centre - particle.radius * touch.normal) : touch.centre;
}

Vec3d ParticleStep::surfaceVelocity(std::size_t collider, const Vec3d& at) const
{
    Vec3d surface = colliders.surfaceVelocity(collider, at);
    if (bodyChanges_.empty()) return surface;
    const BodyChange& change = bodyChanges_[collider];
    return surface + change.linear + change.angular.cross(at - colliders.placement(collider).body.centre);
}

Vec3d ParticleStep::collided(const Vec3d& before, const Touch& touch, double restitution)
{
    const Collider& collider = colliders[touch.collider];
    const Vec3d at = contactPoint(touch);
    // The surface's velocity is that of the end of the step, so it is asked for where the point that was hit is then.
    const Vec3d atEnd = colliders.placement(touch.collider).atEnd(at, touch.when);
    Vec3d after;
    if (collider.body) {
        const Mat3d response =
            Mat3d::Identity() / particle.mass + colliders.placement(touch.collider).body.response(at);
        const Vec3d w = before - surfaceVelocity(touch.collider, atEnd);
        after = before + impulseBetween(w, touch.normal, restitution, collider.friction, response) / particle.mass;
    } else if (colliders.placement(touch.collider).moves) {
        const Vec3d surface = surfaceVelocity(touch.collider, atEnd);
        after = respond(before - surface, touch.normal, restitution, collider.friction) + surface;
    } else {
        after = respond(before, touch.normal, restitution, collider.friction);
    }
    react(touch.collider, at, after - before);
    return after;
}

Vec3d ParticleStep::brought(const Vec3d& before, const Vec3d& target, std::size_t collider, const Vec3d& at)
{
    Vec3d change = target - before;
    if (colliders[collider].body) {
        const Mat3d response = Mat3d::Identity() / particle.mass + colliders.placement(collider).body.response(at);
        change = response.ldlt().solve(change) / particle.mass;
    }
    react(collider, at, change);
    return before + change;
}

Vec3d ParticleStep::drift(std::size_t collider) const
{
    if (!colliders.placement(collider).moves) return Vec3d::Zero();
    return (colliders.carried(collider, start) - start) / options.dt;
}

Vec3d ParticleStep::slid(const Vec3d& average, const Touch& touch, double restitution) const
{
    const double friction = colliders[touch.collider].friction;
    if (!colliders.placement(touch.collider).moves) return respond(average, touch.normal, restitution, friction);
    const Vec3d surface = drift(touch.collider);
    return respond(average - surface, touch.normal, restitution, friction) + surface;
}

void ParticleStep::react(std::size_t collider, const Vec3d& at, const Vec3d& change)
{
    const Vec3d impulse = -particle.mass * change;
    tally.impulse[collider] += impulse;
    tally.angularImpulse[collider] += at.cross(impulse);
    if (!colliders[collider].body) return;
    if (bodyChanges_.empty()) bodyChanges_.resize(colliders.size());
    const BodyShare& body = colliders.placement(collider).body;
    bodyChanges_[collider].linear += body.inverseMass * impulse;
    bodyChanges_[collider].angular += body.inverseInertia * (at - body.centre).cross(impulse);
}

bool ParticleStep::paysForItsHeight(std::size_t collider)
{
    if (!colliders.set().still()) return true;
    const double speed2 = endVelocity.squaredNorm();
    const double allowed2 = particle.velocity.squaredNorm() + 2.0 * options.gravity.dot(candidate - start);
    if (speed2 <= allowed2) return true;
    if (allowed2 < 0.0) return false;
    const Vec3d before = endVelocity;
    endVelocity *= std::sqrt(allowed2 / speed2);
    react(collider, candidate, endVelocity - before);
    return true;
}

void ParticleStep::stop(std::size_t collider)
{
    candidate = colliders.carried(collider, start);
    endVelocity = brought(endVelocity, surfaceVelocity(collider, candidate), collider, candidate);
}

void ParticleStep::hold(std::size_t collider)
{
    stop(collider);
    penetrates();
    ++tally.unresolved;
    unresolved = true;
}

void ParticleStep::record(const Touch& touch)
{
    if (particle.hits == nullptr || particle.touching) return;
    HitRecord& hit = *particle.hits;
    hit.time = colliders.begin() + touch.when * options.dt;
    hit.position = contactPoint(touch);
    hit.normal = touch.hasNormal ? touch.normal : Vec3d(Vec3d::Zero());
    hit.velocity = particle.velocity + touch.when * options.dt * options.gravity;
    hit.collider = static_cast<std::int32_t>(touch.collider);
    ++hit.count;
}

} // namespace vdbounce
