// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/still_colliders.h"

namespace vdbounce::test {

constexpr double kGravity = 9.81;
inline const Vec3d kUp(0, 1, 0);

/// How far grounds() lie from the origin, along their normal: on no voxel of theirs.
constexpr double kGroundOffset = 0.011;
/// The voxel side of grounds(), which reach 40 voxels from the origin.
constexpr double kGroundVoxel = 0.05;

struct Ground {
    const char* name;
    Shape shape;
};

/// The same half space as an analytic plane, as a level set along the axes, and as one turned off them.
std::vector<Ground> grounds(const Vec3d& normal);

StillColliders single(const Ground& ground, double restitution, double friction);

} // namespace vdbounce::test
