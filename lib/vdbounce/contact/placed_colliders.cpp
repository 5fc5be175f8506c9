// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/placed_colliders.h"

#include "vdbounce/contact/motion_reach.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vdbounce {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

} // namespace

Pose Placement::between(double share) const
{
    if (!moves || share >= 1.0) return end;
    const bool stays = begin.rotation == end.rotation && begin.translation == end.translation; // what only deforms
    if (stays) return end;
    if (share <= 0.0) return begin;
    const Eigen::Quaterniond from(begin.rotation);
    const Mat3d rotation = from.slerp(share, Eigen::Quaterniond(end.rotation)).toRotationMatrix();
    const Vec3d local = end.toLocal(velocity.centre);
    const Vec3d start = begin.toWorld(local);
    return {rotation, start + share * (velocity.centre - start) - rotation * local};
}

PlacedColliders::PlacedColliders(const ColliderSet& colliders) : colliders_(&colliders), placements_(colliders.size())
{
    for (std::size_t i = 0; i < placements_.size(); ++i) placements_[i].ballCentre = colliders.boundingBall(i).centre;
}

PlacedColliders::PlacedColliders(const ColliderSet& colliders, double begin, double dt) : PlacedColliders(colliders)
{
    begin_ = begin;
    dt_ = dt;
    if (colliders.still()) return;
    for (std::size_t i = 0; i < placements_.size(); ++i) {
        const Collider& collider = colliders[i];
        Placement& placement = placements_[i];
        placement.beginTime = begin;
        placement.endTime = begin + dt;
        if (!collider.motion.still()) {
            place(i, collider.motion.poseAt(begin), collider.motion.poseAt(begin + dt),
                  collider.motion.velocityAt(begin + dt));
        }
        if (!deforms(collider.shape)) continue;
        placement.moves = true;
        placement.reach += reachOf(collider.shape, begin, begin + dt);
    }
    updateReach();
}

void PlacedColliders::place(std::size_t collider, const Pose& begin, const Pose& end, const RigidVelocity& velocity)
{
    Placement& placement = placements_[collider];
    placement.moves = true;
    placement.begin = begin;
    placement.end = end;
    placement.velocity = velocity;
    placement.ballCentre = end.toWorld(colliders_->boundingBall(collider).centre);
    placement.reach = motionReach(begin, end, velocity, colliders_->boundingBall(collider), dt_);
    updateReach();
}

void PlacedColliders::updateReach()
{
    reach_ = 0.0;
    for (const Placement& placement : placements_) reach_ = std::max(reach_, placement.reach);
}

Probe PlacedColliders::probe(const Vec3d& position, double radius) const
{
    Probe probe{kInfinity, kInfinity, 0};
    for (std::size_t i = 0; i < placements_.size(); ++i) {
        const Placement& placement = placements_[i];
        if (placements_.size() > 1) {
            const double ballRadius = colliders_->boundingBall(i).radius;
            const double away = (position - placement.ballCentre).norm() - ballRadius - radius;
            if (away > 0.0 && away > probe.gap) {
                probe.clearance = std::min(probe.clearance, away);
                continue;
            }
        }
        const Vec3d local = placement.moves ? placement.end.toLocal(position) : position;
        const Nearness near = nearnessOf((*colliders_)[i].shape, local, radius, placement.endTime);
        const double gap = near.phi - radius;
        if (gap < probe.gap) {
            probe.gap = gap;
            probe.collider = i;
        }
        probe.clearance = std::min(probe.clearance, near.clearance);
    }
    return probe;
}

bool PlacedColliders::normalAt(std::size_t collider, const Vec3d& position, Vec3d& normal) const
{
    const Placement& placement = placements_[collider];
    const Shape& shape = (*colliders_)[collider].shape;
    if (!placement.moves) return outwardNormal(shape, position, placement.endTime, normal);
    if (!outwardNormal(shape, placement.end.toLocal(position), placement.endTime, normal)) return false;
    normal = placement.end.vectorToWorld(normal);
    return true;
}

bool PlacedColliders::wayOut(std::size_t collider, const Vec3d& position, Vec3d& direction, double& distance) const
{
    distance = 0.0;
    if (normalAt(collider, position, direction)) return true;
    const Placement& placement = placements_[collider];
    Vec3d way;
    if (!nearestOutsideOf((*colliders_)[collider].shape, placement.end.toLocal(position), placement.endTime, way))
        return false;
    distance = way.norm();
    if (!(distance > 0.0)) return false;
    direction = placement.end.vectorToWorld(way / distance);
    return true;
}

Vec3d PlacedColliders::surfaceVelocity(std::size_t collider, const Vec3d& position) const
{
    const Placement& placement = placements_[collider];
    if (!placement.moves) return Vec3d::Zero();
    const Vec3d deforming =
        deformationVelocity((*colliders_)[collider].shape, placement.end.toLocal(position), placement.endTime);
    return placement.velocity.at(position) + placement.end.vectorToWorld(deforming);
}

Vec3d PlacedColliders::carried(std::size_t collider, const Vec3d& position) const
{
    const Placement& placement = placements_[collider];
    if (!placement.moves) return position;
    const Vec3d local = placement.begin.toLocal(position);
    const Vec3d deforming = deformationVelocity((*colliders_)[collider].shape, local, placement.beginTime);
    return placement.end.toWorld(local + dt_ * deforming);
}

} // namespace vdbounce
