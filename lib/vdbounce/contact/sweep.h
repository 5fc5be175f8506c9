// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/placed_colliders.h"

namespace vdbounce {

/// When to look for collisions along a particle's path and not only at its end.
enum class Sweep {
    Auto,   ///< where the step may have touched on the way what has walls that such a step could pass: it is
            ///< longer than half a voxel, or a 32nd of the thinnest wall of a shape by formula
    Always, ///< where the step may have touched something on the way
    Never,
};

/// What scenes and reports call them, in the enumeration's order.
constexpr const char* kSweepNames[] = {"auto", "always", "never"};
inline const char* nameOf(Sweep sweep) { return kSweepNames[int(sweep)]; }

/// Whether a way is long enough to be searched, against walls that are told apart on `wallLength`.
bool sweepIsDue(Sweep sweep, double way, double wallLength);

/// The same of one whose way, with what colliders move meanwhile, may be free: `clear` is what the clearances at both
/// of its ends add up to.
inline bool sweepIsDue(Sweep sweep, double way, double clear, double wallLength)
{
    return way > clear && sweepIsDue(sweep, way, wallLength);
}

/// Where along a straight path a particle first touches a collider. World space.
struct PathHit {
    bool hit = false;
    double when = 1.0; ///< share of the path, 0 to 1
    Vec3d position;    ///< the last known free place before the hit; without one the path's end
    Vec3d normal;      ///< of the collider there and then, unit length, outward
    bool hasNormal = false;
    std::size_t collider = 0;
};

/// The first touch of a particle that moves evenly from `from` to `to` while the colliders make their step.
///
/// `from` must be free at the step's beginning. Against each collider whose bounding ball the path meets: the path in
/// the collider's own frame, where a level set is searched cell by cell (see firstTouch()); a path that curves there,
/// because the collider turns, in pieces that stay within a twentieth of a voxel of it. Deforming colliders are
/// searched in strides that cannot pass a surface, but of at least a quarter of a voxel; shapes by formula likewise, of
/// at least an eighth of a short path, their resolution() or a hundred thousandth of a long path. Colliders are left
/// out for which sweepIsDue() says no. Method: lecture, slides 11, 12 and 15; conservative advancement, Mirtich 1996.
PathHit sweepPath(const PlacedColliders& colliders, const Vec3d& from, const Vec3d& to, double radius,
                  Sweep sweep = Sweep::Always);

} // namespace vdbounce
