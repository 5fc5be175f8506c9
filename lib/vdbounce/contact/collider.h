// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"
#include "vdbounce/contact/motion.h"
#include "vdbounce/contact/rigid_body.h"
#include "vdbounce/contact/shape.h"

#include <optional>
#include <string>
#include <vector>

namespace vdbounce {

/// What happens to a particle that touches a collider.
enum class OnHit {
    Bounce,
    Stick,  ///< stays where it touched and moves along with the collider
    Delete, ///< is removed
};

/// Something that particles cannot enter: where phi < 0.
struct Collider {
    std::string name;
    Shape shape;
    double restitution = 0.3; ///< 0 to 1: the share of the normal velocity that a collision gives back
    double friction = 0.5;    ///< Coulomb's mu, >= 0
    OnHit onHit = OnHit::Bounce;
    Motion motion{};                ///< of the shape, as its file has it
    std::optional<BodyMass> body{}; ///< present: it moves freely, by gravity and what hits it, and `motion` is none
};

/// The colliders of a scene. Read-only, safe to use from any number of threads. Where they are during a step, and what
/// surrounds a particle, is told by PlacedColliders.
class ColliderSet {
public:
    explicit ColliderSet(std::vector<Collider> colliders);

    std::size_t size() const { return colliders_.size(); }
    const Collider& operator[](std::size_t i) const { return colliders_[i]; }
    const BoundingBall& boundingBall(std::size_t i) const { return balls_[i]; }

    /// No collider ever moves or deforms.
    bool still() const { return still_; }
    /// Some collider is moved by particles.
    bool anyFree() const { return anyFree_; }

    /// The smallest voxel side of all level sets, world units. Infinite where there are none.
    double smallestVoxel() const { return smallestVoxel_; }

    /// The smallest length on which walls can be told apart, see wallLengthOf(). Infinite for planes alone.
    double wallLength() const { return wallLength_; }

private:
    std::vector<Collider> colliders_;
    std::vector<BoundingBall> balls_;
    double smallestVoxel_;
    double wallLength_;
    bool still_ = true;
    bool anyFree_ = false;
};

} // namespace vdbounce
