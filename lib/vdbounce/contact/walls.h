// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"

#include <array>
#include <cstddef>

namespace vdbounce {

/// The surfaces that a particle touches in one step, up to three, answered together: in a wedge or corner one after the
/// other would converge slowly or not at all.
class Walls {
public:
    static constexpr int kMost = 3;

    struct Wall {
        Vec3d normal; ///< unit length, outward
        std::size_t collider = 0;
        double friction = 0.0;          ///< Coulomb's mu
        Vec3d velocity = Vec3d::Zero(); ///< of the surface
        double leave = 0.0; ///< the least speed along the normal, relative to the surface, that is asked for
    };

    /// Notes a touch. A surface of the same collider whose normal is within some 18 degrees of an earlier one is that
    /// one: it curves. A fourth takes the place of the oldest. Returns its place.
    int add(const Vec3d& normal, std::size_t collider, double friction, bool& known);

    int count() const { return count_; }
    Wall& operator[](int i) { return walls_[static_cast<std::size_t>(i)]; }
    const Wall& operator[](int i) const { return walls_[static_cast<std::size_t>(i)]; }

    /// Inelastic contact of a velocity with all walls at once: the smallest impulses along the normals after which no
    /// wall is approached, and Coulomb friction along what is left free. `changes` tells each wall's part of the
    /// change. Where no such impulses exist, as between two parallel walls, the velocity is left as it is and false
    /// returned.
    bool answer(Vec3d& velocity, std::array<Vec3d, kMost>& changes) const;

private:
    bool holds(const Vec3d& velocity, const Vec3d& before) const;
    bool answerOne(int i, const Vec3d& velocity, std::array<Vec3d, kMost>& changes) const;
    bool answerTwo(int i, int j, const Vec3d& velocity, std::array<Vec3d, kMost>& changes) const;
    bool answerThree(const Vec3d& velocity, std::array<Vec3d, kMost>& changes) const;
    double missing(int i, const Vec3d& velocity) const;

    std::array<Wall, kMost> walls_;
    int count_ = 0;
    int oldest_ = 0;
};

} // namespace vdbounce
