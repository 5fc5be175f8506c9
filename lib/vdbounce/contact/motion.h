// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/pose.h"

#include <variant>
#include <vector>

namespace vdbounce {

/// A rigid motion that is known beforehand: none, a constant one, or one through keys. Times in seconds.
class Motion {
public:
    /// From the place in which the collider's file has it, at time 0.
    struct Constant {
        Vec3d velocity = Vec3d::Zero();        ///< of `centre`
        Vec3d angularVelocity = Vec3d::Zero(); ///< radians a second about `centre`, which moves along
        Vec3d centre = Vec3d::Zero();          ///< world, at time 0
    };

    /// World = rotate * (as in the file) + translate. Between keys `translate` is interpolated linearly and `rotate`
    /// at constant angular velocity along the shorter way; before the first key and after the last it rests.
    struct Key {
        double time = 0.0;
        Vec3d translate = Vec3d::Zero();
        Eigen::Quaterniond rotate = Eigen::Quaterniond::Identity(); ///< of any length but 0
    };

    Motion() = default; ///< none
    explicit Motion(const Constant& constant);
    /// `keys` in ascending order of time, at least one; throws UsageError otherwise.
    explicit Motion(std::vector<Key> keys);

    bool still() const { return std::holds_alternative<std::monostate>(motion_); }

    bool keyed() const { return std::holds_alternative<std::vector<Key>>(motion_); }

    Pose poseAt(double time) const;

    /// At a key: that of the motion that ends there.
    RigidVelocity velocityAt(double time) const;

private:
    std::variant<std::monostate, Constant, std::vector<Key>> motion_;
};

} // namespace vdbounce
