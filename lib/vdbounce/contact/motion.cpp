// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/motion.h"

#include "vdbounce/base/error.h"

#include <algorithm>

namespace vdbounce {
namespace {

using Keys = std::vector<Motion::Key>;

Mat3d turnedBy(const Vec3d& angles)
{
    const double angle = angles.norm();
    if (!(angle > 0.0)) return Mat3d::Identity();
    return Eigen::AngleAxisd(angle, angles / angle).toRotationMatrix();
}

Pose poseOf(std::monostate, double) { return {}; }

Pose poseOf(const Motion::Constant& motion, double time)
{
    const Mat3d rotation = turnedBy(time * motion.angularVelocity);
    return {rotation, motion.centre + time * motion.velocity - rotation * motion.centre};
}

// The two keys around a time; the same one twice before the first and after the last.
std::pair<const Motion::Key*, const Motion::Key*> keysAround(const Keys& keys, double time)
{
    const auto after =
        std::lower_bound(keys.begin(), keys.end(), time, [](const Motion::Key& key, double t) { return key.time < t; });
    if (after == keys.end()) return {&keys.back(), &keys.back()};
    if (after == keys.begin()) return {&*after, &*after};
    return {&*(after - 1), &*after};
}

Pose poseOf(const Keys& keys, double time)
{
    const auto [a, b] = keysAround(keys, time);
    if (a == b) return {a->rotate.toRotationMatrix(), a->translate};
    const double share = (time - a->time) / (b->time - a->time);
    return {a->rotate.slerp(share, b->rotate).toRotationMatrix(), a->translate + share * (b->translate - a->translate)};
}

RigidVelocity velocityOf(std::monostate, double) { return {}; }

RigidVelocity velocityOf(const Motion::Constant& motion, double time)
{
    return {motion.velocity, motion.angularVelocity, motion.centre + time * motion.velocity};
}

RigidVelocity velocityOf(const Keys& keys, double time)
{
    const auto [a, b] = keysAround(keys, time);
    if (a == b) return {Vec3d::Zero(), Vec3d::Zero(), a->translate};
    const double duration = b->time - a->time;
    Eigen::Quaterniond turn = b->rotate * a->rotate.conjugate();
    if (turn.w() < 0.0) turn.coeffs() *= -1.0; // the shorter way
    const Eigen::AngleAxisd angleAxis(turn);
    return {(b->translate - a->translate) / duration, angleAxis.axis() * angleAxis.angle() / duration,
            poseOf(keys, time).translation};
}

} // namespace

Motion::Motion(const Constant& constant)
{
    if (constant.velocity.isZero(0.0) && constant.angularVelocity.isZero(0.0)) return;
    motion_ = constant;
}

Motion::Motion(std::vector<Key> keys)
{
    if (keys.empty()) throw UsageError("motion.keys", "is empty", "give at least one key");
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const double length = keys[i].rotate.norm();
        if (!(length > 0.0) || !std::isfinite(length) || !keys[i].translate.allFinite() ||
            !std::isfinite(keys[i].time)) {
            throw UsageError("motion.keys[" + std::to_string(i) + "]", "is not finite or its rotation is zero",
                             "give a finite time, translate and a rotate that is not zero");
        }
        if (i > 0 && !(keys[i].time > keys[i - 1].time)) {
            throw UsageError("motion.keys[" + std::to_string(i) + "].time", "is not after the key before",
                             "order keys by time");
        }
        keys[i].rotate.normalize();
    }
    motion_ = std::move(keys);
}

Pose Motion::poseAt(double time) const
{
    return std::visit([&](const auto& motion) { return poseOf(motion, time); }, motion_);
}

RigidVelocity Motion::velocityAt(double time) const
{
    return std::visit([&](const auto& motion) { return velocityOf(motion, time); }, motion_);
}

} // namespace vdbounce
