// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"
#include "vdbounce/base/vector.h"
#include "vdbounce/particles/hit_record.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vdbounce {

/// A set of particles as a structure of arrays, world space, SI units or whatever the scene uses consistently.
///
/// `position` and `id` always have one entry a particle. The other arrays either have one entry a particle too or
/// are empty, which means that the file carries none: velocity is then zero, radius and mass are the scene's.
struct Particles {
    std::vector<Vec3d> position;
    std::vector<Vec3d> velocity;
    std::vector<double> radius;   ///< world units, >= 0; 0 is a point
    std::vector<double> mass;     ///< > 0
    std::vector<std::int64_t> id; ///< kept through everything; the position in the input where the file has none

    std::vector<HitRecord> hits;       ///< of collisions, where they are asked for
    std::vector<std::int32_t> stuckTo; ///< the collider that it moves along with, by its place in the scene; -1: none
    std::vector<std::uint8_t>
        rejected; ///< 1: kept as it came, because it is not finite or has a negative radius or mass

    std::size_t size() const { return position.size(); }
    bool empty() const { return position.empty(); }

    /// Gives every array that is present `count` entries; new ids continue by position.
    void resize(std::size_t count);

    /// Fills `velocity` with zeros where it is absent.
    void ensureVelocity();
};

/// Sets id to 0, 1, 2, ...
void numberInOrder(Particles& particles);

/// The box around all particles with finite positions; empty where there are none.
Box boundingBox(const Particles& particles);

/// The particle indices in ascending order of id; equal ids keep their order.
std::vector<std::size_t> orderById(const Particles& particles);

/// The particles at `order`, in that order, with all their attributes.
Particles reordered(const Particles& particles, const std::vector<std::size_t>& order);

} // namespace vdbounce
