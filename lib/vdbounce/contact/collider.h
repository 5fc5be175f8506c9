// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"
#include "vdbounce/field/distance_field.h"
#include "vdbounce/field/plane_field.h"

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace vdbounce {

/// Something that particles cannot enter: where phi < 0.
struct Collider {
    std::string name;
    std::variant<PlaneField, std::shared_ptr<const DistanceField>> shape;
    double restitution = 0.3; ///< 0 to 1: the share of the normal velocity that a collision gives back
    double friction = 0.5;    ///< Coulomb's mu, >= 0
};

/// What surrounds a particle at a point.
struct Probe {
    double gap =
        0.0; ///< smallest phi - radius over the colliders, world units; negative when the particle penetrates one
    double clearance = 0.0; ///< how far the particle can move in any direction without any gap becoming negative, >= 0
    std::size_t collider = 0; ///< the one with the smallest gap
};

/// The colliders of a scene, asked together. Read-only, safe to use from any number of threads.
class ColliderSet {
public:
    explicit ColliderSet(std::vector<Collider> colliders);

    std::size_t size() const { return colliders_.size(); }
    const Collider& operator[](std::size_t i) const { return colliders_[i]; }

    /// Without colliders everything is infinitely far away.
    Probe probe(const Vec3d& position, double radius) const;

    /// The outward unit normal of a collider's field at a point. False where the gradient tells none, which is deep
    /// inside or outside a narrow band and where it cancels out.
    bool normalAt(std::size_t collider, const Vec3d& position, Vec3d& normal) const;

    /// The direction that leads out of a collider: the normal, or so deep in a narrow band that there is none, the
    /// straight way to the nearest place known to be outside, with its length in `distance` (else 0). False where none
    /// is known.
    bool wayOut(std::size_t collider, const Vec3d& position, Vec3d& direction, double& distance) const;

    /// The smallest voxel side of all level sets, world units: no wall thinner than twice this can be told from
    /// nothing. Infinite where there are none.
    double smallestVoxel() const { return smallestVoxel_; }

private:
    std::vector<Collider> colliders_;
    double smallestVoxel_;
};

} // namespace vdbounce
