// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/collider.h"

#include <vector>

namespace vdbounce {

/// What surrounds a particle at a point.
struct Probe {
    double gap =
        0.0; ///< smallest phi - radius over the colliders, world units; negative when the particle penetrates one
    double clearance = 0.0; ///< how far the particle can move in any direction without any gap becoming negative, >= 0
    std::size_t collider = 0; ///< the one with the smallest gap
};

/// Where one collider is during one step.
struct Placement {
    bool moves = false; ///< else the poses are the identity
    Pose begin;
    Pose end;
    RigidVelocity velocity; ///< at the end of the step
    double beginTime = 0.0; ///< seconds
    double endTime = 0.0;
    double reach = 0.0; ///< the farthest that any of its points moves in the step, world units; infinite for planes
                        ///< that turn
    Vec3d ballCentre = Vec3d::Zero(); ///< at the end of the step
    BodyShare body;                   ///< of a collider that particles move

    /// The pose at a time of the step, 0 to 1: the centre of motion moves straight, the rotation evenly.
    Pose between(double share) const;
    double timeAt(double share) const { return beginTime + share * (endTime - beginTime); }

    /// Where the collider's point that is at `world` at that time is at the end of the step.
    Vec3d atEnd(const Vec3d& world, double share) const
    {
        return moves && share < 1.0 ? end.toWorld(between(share).toLocal(world)) : world;
    }
};

/// The colliders of a scene during one step, asked together. Everything is told for the end of the step, as the lecture
/// asks (slide 11). Read-only, safe to use from any number of threads.
class PlacedColliders {
public:
    /// Colliders without a motion of their own, and free bodies at rest in the place in which their files have them.
    explicit PlacedColliders(const ColliderSet& colliders);

    /// Along their motions from time `begin` on, `dt` seconds long. Free bodies stay as above until place() is called.
    PlacedColliders(const ColliderSet& colliders, double begin, double dt);

    /// A free body's way through the step.
    void place(std::size_t collider, const Pose& begin, const Pose& end, const RigidVelocity& velocity);
    /// What impulses within the step have made of its velocity at the end.
    void setVelocity(std::size_t collider, const RigidVelocity& velocity) { placements_[collider].velocity = velocity; }
    /// How many particles share a free body's mass in this step.
    void share(std::size_t collider, const BodyShare& share) { placements_[collider].body = share; }

    const ColliderSet& set() const { return *colliders_; }
    std::size_t size() const { return colliders_->size(); }
    const Collider& operator[](std::size_t i) const { return (*colliders_)[i]; }
    const Placement& placement(std::size_t i) const { return placements_[i]; }
    double begin() const { return begin_; }
    double dt() const { return dt_; }

    /// The farthest that any collider's surface moves in this step, world units.
    double reach() const { return reach_; }

    /// Without colliders everything is infinitely far away. Colliders whose bounding ball is farther than the nearest
    /// gap are not looked up.
    Probe probe(const Vec3d& position, double radius) const;

    /// The outward unit normal of a collider at a point, see outwardNormal().
    bool normalAt(std::size_t collider, const Vec3d& position, Vec3d& normal) const;

    /// The direction that leads out of a collider: the normal, or so deep in a narrow band that there is none, the
    /// straight way to the nearest place known to be outside, with its length in `distance` (else 0). False where none
    /// is known.
    bool wayOut(std::size_t collider, const Vec3d& position, Vec3d& direction, double& distance) const;

    /// Velocity of a collider's surface at a point, at the end of the step.
    Vec3d surfaceVelocity(std::size_t collider, const Vec3d& position) const;

    /// Where the point of a collider that is at `position` when the step begins is when it ends.
    Vec3d carried(std::size_t collider, const Vec3d& position) const;

    double wallLength() const { return colliders_->wallLength(); }

private:
    void updateReach();

    const ColliderSet* colliders_;
    std::vector<Placement> placements_;
    double begin_ = 0.0;
    double dt_ = 0.0;
    double reach_ = 0.0;
};

} // namespace vdbounce
