// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/one_particle.h"

#include "vdbounce/contact/placed_colliders.h"

#include <initializer_list>

namespace vdbounce::test {

inline Motion moving(const Vec3d& velocity, const Vec3d& angular = Vec3d::Zero(), const Vec3d& centre = Vec3d::Zero())
{
    return Motion(Motion::Constant{velocity, angular, centre});
}

inline Collider collider(const Shape& shape, double restitution, double friction, const Motion& motion,
                         OnHit onHit = OnHit::Bounce)
{
    Collider result{"thing", shape, restitution, friction, onHit};
    result.motion = motion;
    return result;
}

/// Colliders that move by themselves, with their time.
class MovingScene {
public:
    MovingScene(std::vector<Collider> colliders, const StepOptions& options)
        : set_(std::move(colliders)), options_(options), placed_(set_, 0.0, 0.0), tally_(set_.size())
    {
    }

    MovingScene(const MovingScene&) = delete; // what is placed refers to the set
    MovingScene& operator=(const MovingScene&) = delete;

    /// A particle that begins with them.
    MovingParticle particle(const Vec3d& position, const Vec3d& velocity, double radius = 0.0) const
    {
        return placed(position, velocity, placed_, radius);
    }

    /// One step of one particle, or of several that do not see each other.
    void advance(std::initializer_list<MovingParticle*> particles)
    {
        placed_ = PlacedColliders(set_, double(steps_) * options_.dt, options_.dt);
        ++steps_;
        for (MovingParticle* particle : particles) step(*particle, placed_, options_, tally_);
    }
    void advance(MovingParticle& particle) { advance({&particle}); }

    double gap(const MovingParticle& particle) const { return placed_.probe(particle.position, particle.radius).gap; }
    /// Where the first collider was when the last step began, and where it is now.
    const Placement& placement() const { return placed_.placement(0); }
    const StepTally& tally() const { return tally_; }
    double time() const { return double(steps_) * options_.dt; }

private:
    ColliderSet set_;
    StepOptions options_;
    PlacedColliders placed_;
    StepTally tally_;
    std::uint64_t steps_ = 0;
};

} // namespace vdbounce::test
