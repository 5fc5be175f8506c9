// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vdbounce {

/// How particles answer each other.
struct InteractOptions {
    double restitution = 0.3; ///< 0 to 1
    double friction = 0.5;    ///< Coulomb's mu, >= 0
};

/// Spheres as particle contact sees them: one entry a particle.
struct Spheres {
    std::vector<double> radius;        ///< world units, >= 0
    std::vector<double> inverseMass;   ///< 0: not moved by others
    std::vector<std::uint8_t> skipped; ///< 1: touches nothing
};

/// Contact of particles with each other during one step, as the lecture treats it with colliders (slides 8 and 10):
/// elastic collisions of the velocities from the start of the step, then, after the colliders have answered, inelastic
/// contact over the whole step.
///
/// Pairs are answered one after the other by equal and opposite impulses, so momentum is kept to rounding and no pair
/// gains energy. Pairs belong to cells, cells to sets (CellList::colourOf()); the cells of one set share no particle
/// and run in parallel, so there are the same bits for any number of threads. Particles do not turn. Particles that
/// move farther in a step than the largest radius may pass each other unnoticed.
class ParticleContact {
public:
    /// Finds the pairs that may touch in a step of `dt` seconds. `spheres` must outlive this.
    ParticleContact(const Spheres& spheres, const std::vector<Vec3d>& positions, const std::vector<Vec3d>& velocities,
                    double dt, const InteractOptions& options);

    /// The elastic collisions: changes the velocities that particles have at the start of the step.
    void collide(const std::vector<Vec3d>& positions, std::vector<Vec3d>& velocities, double dt) const;

    /// One round of inelastic contact among particles that went from `starts` to `ends`, where their velocities are
    /// `endVelocities`. Changes both, and marks in `changed` what it moved. False when nothing touches any more.
    bool rest(const std::vector<Vec3d>& starts, std::vector<Vec3d>& ends, std::vector<Vec3d>& endVelocities,
              std::vector<std::uint8_t>& changed) const;

private:
    struct Pair {
        std::uint32_t a;
        std::uint32_t b;
    };
    struct Cell { // a stretch of pairs
        std::size_t begin;
        std::size_t end;
    };

    bool meets(const Pair& pair, const std::vector<Vec3d>& starts, const Vec3d& endA, const Vec3d& endB, double margin,
               Vec3d& normal) const;
    template <class Answer> void forEachPair(const Answer& answer) const;

    const Spheres& spheres_;
    InteractOptions options_;
    std::vector<Pair> pairs_;
    std::array<std::vector<Cell>, 27> colours_;
};

} // namespace vdbounce
