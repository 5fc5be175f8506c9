// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/placed_colliders.h"

namespace vdbounce {

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
/// searched in strides that cannot pass a surface, but of at least a quarter of a voxel. Method: lecture, slides 11,
/// 12 and 15.
PathHit sweepPath(const PlacedColliders& colliders, const Vec3d& from, const Vec3d& to, double radius);

} // namespace vdbounce
