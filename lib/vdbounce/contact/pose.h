// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"

#include <Eigen/Geometry>

namespace vdbounce {

/// Where a rigid body is: world = rotation * local + translation.
struct Pose {
    Mat3d rotation = Mat3d::Identity();
    Vec3d translation = Vec3d::Zero();

    Vec3d toWorld(const Vec3d& local) const { return rotation * local + translation; }
    Vec3d toLocal(const Vec3d& world) const { return rotation.transpose() * (world - translation); }
    Vec3d vectorToWorld(const Vec3d& local) const { return rotation * local; }
    Vec3d vectorToLocal(const Vec3d& world) const { return rotation.transpose() * world; }
};

/// How a rigid body moves at an instant: velocity at x is linear + angular x (x - centre). World space.
struct RigidVelocity {
    Vec3d linear = Vec3d::Zero();  ///< of the centre
    Vec3d angular = Vec3d::Zero(); ///< radians a second, right-handed
    Vec3d centre = Vec3d::Zero();

    Vec3d at(const Vec3d& world) const { return linear + angular.cross(world - centre); }
};

} // namespace vdbounce
