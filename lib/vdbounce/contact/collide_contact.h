// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/response.h"
#include "vdbounce/contact/step.h"
#include "vdbounce/contact/sweep.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

/// @file
/// The lecture's collide-contact as step() runs it; only step.cpp includes this.

namespace vdbounce {

// Contact iterations a step. Curved surfaces take two or three, a wedge of two colliders ten; more is a pocket too
// narrow.
constexpr int kMaxContacts = 16;

// What contact moves out beyond the surface, as a share of the depth: closes in from inside geometrically otherwise.
constexpr double kPushMargin = 1e-3;

// The least that a push moves a particle, in voxels: a thousandth of what trilinear interpolation can resolve.
constexpr double kSmallestPushVx = 1e-6;

// The share of its depth that a particle which began inside is moved out in one step.
constexpr double kRecovery = 0.2;

// Depth that it is moved out of at once, voxels: too little to be seen, and a share of it would never end.
constexpr double kShallowVx = 0.05;

// The shortest step of a search along a path, voxels. Two voxels is the thinnest wall that a grid can hold.
constexpr double kSweepStepVx = 0.25;

// Positions are rounded each time that they are added to; the clearance gives up a few units in the last place for it.
inline double roundingOf(const Vec3d& position)
{
    return 4.0 * std::numeric_limits<double>::epsilon() * position.cwiseAbs().maxCoeff();
}

struct Touch {
    bool touching = false;
    bool hasNormal = false;
    std::size_t collider = 0;
    Vec3d normal;
    Vec3d centre;       // the particle's, where it touches
    double depth = 0.0; // at the end of the path; 0 where only the way there touched
};

// One particle's step. Holds the state that its phases share.
class CollideContact {
public:
    CollideContact(MovingParticle& particle, const ColliderSet& colliders, const StepOptions& options, StepTally& tally)
        : particle_(particle), colliders_(colliders), options_(options), tally_(tally), start_(particle.position),
          velocity_(particle.velocity)
    {
        makeCandidate();
    }

    void run()
    {
        const double way = (candidate_ - start_).norm();
        if (!std::isfinite(way)) {
            // Faster than numbers go: nothing can be said about where it would be.
            ++tally_.near;
            ++tally_.unresolved;
            return;
        }
        if (way < particle_.clearance) {
            ++tally_.free;
            accept();
            particle_.clearance -= way + roundingOf(candidate_);
            return;
        }
        ++tally_.near;
        if (particle_.inside) {
            recover();
        } else {
            Touch touch = look();
            if (touch.touching) {
                ++tally_.contacts;
                touch = bounce(touch);
                const std::size_t last = touch.collider;
                touch = rest(touch);
                if (touch.touching || !paysForItsHeight(last)) hold(touch.touching ? touch.collider : last);
            }
        }
        accept();
        particle_.clearance = probe_.clearance;
        particle_.inside = probe_.gap < 0.0;
        if (particle_.inside) {
            ++tally_.unresolved;
            tally_.maxPenetration = std::max(tally_.maxPenetration, -probe_.gap);
        }
    }

private:
    void makeCandidate()
    {
        endVelocity_ = velocity_ + options_.dt * options_.gravity;
        candidate_ = start_ + options_.dt * 0.5 * (velocity_ + endVelocity_);
    }

    void accept()
    {
        particle_.position = candidate_;
        particle_.velocity = endVelocity_;
    }

    // Whether the candidate, or the way to it, touches a collider. Leaves the surroundings of the candidate in probe_.
    Touch look()
    {
        probe_ = colliders_.probe(candidate_, particle_.radius);
        Touch touch;
        touch.depth = std::max(0.0, -probe_.gap);
        if (mayHaveTouchedOnTheWay()) {
            if (!swept_) ++tally_.swept;
            swept_ = true;
            const PathHit hit =
                sweepPath(colliders_, start_, candidate_, particle_.radius, kSweepStepVx * shortLength());
            if (hit.hit) {
                touch.touching = true;
                touch.collider = hit.collider;
                touch.centre = hit.position;
                touch.hasNormal = colliders_.normalAt(hit.collider, hit.position, touch.normal);
                return touch;
            }
        }
        touch.touching = probe_.gap < 0.0;
        touch.collider = probe_.collider;
        touch.centre = candidate_;
        if (touch.touching) touch.hasNormal = colliders_.normalAt(probe_.collider, candidate_, touch.normal);
        return touch;
    }

    bool mayHaveTouchedOnTheWay() const
    {
        if (options_.sweep == Sweep::Never) return false;
        const double way = (candidate_ - start_).norm();
        if (options_.sweep == Sweep::Auto && way <= colliders_.smallestVoxel()) return false;
        return way > particle_.clearance + probe_.clearance;
    }

    // The length on which walls are told apart; planes alone have none, and any will do.
    double shortLength() const
    {
        const double voxel = colliders_.smallestVoxel();
        return voxel < std::numeric_limits<double>::infinity() ? voxel : 0.25 * (candidate_ - start_).norm();
    }

    // Step 2: elastic collisions of the velocity from the start of the step.
    Touch bounce(Touch touch)
    {
        for (int i = 0; i < options_.maxBounces && touch.touching && touch.hasNormal; ++i) {
            if (!(velocity_.dot(touch.normal) < 0.0)) break;
            const Collider& collider = colliders_[touch.collider];
            const Vec3d before = velocity_;
            velocity_ = respond(velocity_, touch.normal, collider.restitution, collider.friction);
            react(touch.collider, contactPoint(touch), velocity_ - before);
            makeCandidate();
            touch = look();
        }
        return touch;
    }

    // Step 3: inelastic contact over the whole step.
    Touch rest(Touch touch)
    {
        Vec3d average = (candidate_ - start_) / options_.dt;
        for (int i = 0; i < kMaxContacts && touch.touching && touch.hasNormal; ++i) {
            const double friction = colliders_[touch.collider].friction;
            const bool approached = average.dot(touch.normal) < 0.0;
            average = respond(average, touch.normal, 0.0, friction);
            answerEndVelocity(touch.collider, contactPoint(touch), touch.normal, friction);
            // Nothing approaches any more and still it is inside: the surface curves. Only then is it moved out.
            if (!approached || i > 0) {
                average += pushOut(touch.depth) / options_.dt * touch.normal;
            }
            candidate_ = start_ + options_.dt * average;
            touch = look();
        }
        return touch;
    }

    // How far to move out what is `depth` inside.
    double pushOut(double depth) const
    {
        return std::max((1.0 + kPushMargin) * depth, kSmallestPushVx * shortLength());
    }

    void answerEndVelocity(std::size_t collider, const Vec3d& at, const Vec3d& normal, double friction)
    {
        const Vec3d before = endVelocity_;
        endVelocity_ = respond(endVelocity_, normal, 0.0, friction);
        react(collider, at, endVelocity_ - before);
    }

    Vec3d contactPoint(const Touch& touch) const
    {
        return touch.hasNormal ? Vec3d(touch.centre - particle_.radius * touch.normal) : touch.centre;
    }

    // A collider at rest does no work, but moving a particle out of a curved surface may lift it: what it gained in
    // height is taken from its speed. False when its speed cannot pay.
    bool paysForItsHeight(std::size_t collider)
    {
        const double speed2 = endVelocity_.squaredNorm();
        const double allowed2 = particle_.velocity.squaredNorm() + 2.0 * options_.gravity.dot(candidate_ - start_);
        if (speed2 <= allowed2) return true;
        if (allowed2 < 0.0) return false;
        const Vec3d before = endVelocity_;
        endVelocity_ *= std::sqrt(allowed2 / speed2);
        react(collider, candidate_, endVelocity_ - before);
        return true;
    }

    // Back to where it was, at rest.
    void stop(std::size_t collider)
    {
        react(collider, start_, -endVelocity_);
        endVelocity_ = Vec3d::Zero();
        candidate_ = start_;
    }

    // Started outside and could not be brought out again.
    void hold(std::size_t collider)
    {
        stop(collider);
        probe_ = colliders_.probe(candidate_, particle_.radius);
        ++tally_.unresolved;
    }

    // Started inside: what still moves in is answered first, so that it cannot pass through; what is left inside then
    // is answered inelastically and moved out by a share of its depth (lecture, slide 3: both ends penetrate).
    void recover()
    {
        turnBack();
        probe_ = colliders_.probe(candidate_, particle_.radius);
        if (!(probe_.gap < 0.0)) return;
        ++tally_.contacts;
        const std::size_t collider = probe_.collider;
        Vec3d normal;
        double distance = 0.0;
        if (!colliders_.wayOut(collider, candidate_, normal, distance)) {
            stop(collider); // nobody knows where outside is: it must not sink deeper
        } else {
            const double friction = colliders_[collider].friction;
            const Vec3d average = respond((candidate_ - start_) / options_.dt, normal, 0.0, friction);
            answerEndVelocity(collider, candidate_ - particle_.radius * normal, normal, friction);
            const double depth = std::max(distance, -probe_.gap);
            const double push = depth < kShallowVx * shortLength() ? pushOut(depth) : kRecovery * depth;
            candidate_ = start_ + options_.dt * average + push * normal;
        }
        probe_ = colliders_.probe(candidate_, particle_.radius);
    }

    // An inelastic answer of the velocity from the start of the step, with the normal there.
    void turnBack()
    {
        const std::size_t collider = colliders_.probe(start_, particle_.radius).collider;
        Vec3d normal;
        double distance = 0.0;
        if (!colliders_.wayOut(collider, start_, normal, distance)) return;
        const Vec3d before = velocity_;
        velocity_ = respond(velocity_, normal, 0.0, colliders_[collider].friction);
        react(collider, start_ - particle_.radius * normal, velocity_ - before);
        makeCandidate();
    }

    // The particle's velocity changed by `change` through this collider, which takes, at the point `at`, the opposite
    // impulse.
    void react(std::size_t collider, const Vec3d& at, const Vec3d& change)
    {
        const Vec3d impulse = -particle_.mass * change;
        tally_.impulse[collider] += impulse;
        tally_.angularImpulse[collider] += at.cross(impulse);
    }

    MovingParticle& particle_;
    const ColliderSet& colliders_;
    const StepOptions& options_;
    StepTally& tally_;
    const Vec3d start_;
    Vec3d velocity_; // at the start of the step, after the collisions so far
    Vec3d endVelocity_;
    Vec3d candidate_;
    Probe probe_;
    bool swept_ = false;
};

} // namespace vdbounce
