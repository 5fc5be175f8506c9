// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/placed_colliders.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vdbounce {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The centre of motion goes straight; every point of the ball turns around it by no more than its distance allows.
double reachOf(const Placement& placement, const BoundingBall& ball, double dt)
{
    const Vec3d centre = placement.end.toLocal(placement.velocity.centre);
    const double straight = (placement.end.toWorld(centre) - placement.begin.toWorld(centre)).norm();
    // |R1 - R0| / sqrt(2) in the Frobenius norm is the chord of the turn, and its arc at most pi/2 times that; a
    // turn of more than half a circle shows in the velocity only.
    const double chord = (placement.end.rotation - placement.begin.rotation).norm() / std::sqrt(2.0);
    const double angle = std::max(0.5 * M_PI * chord, dt * placement.velocity.angular.norm());
    return angle > 0.0 ? straight + angle * ((ball.centre - centre).norm() + ball.radius) : straight;
}

} // namespace

Pose Placement::between(double share) const
{
    if (!moves || share >= 1.0) return end;
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
        placement.beginShare = shareAt(collider.shape, begin);
        placement.endShare = shareAt(collider.shape, begin + dt);
        if (!collider.motion.still()) {
            place(i, collider.motion.poseAt(begin), collider.motion.poseAt(begin + dt),
                  collider.motion.velocityAt(begin + dt));
        }
        // Its form changes, though nothing needs to be added to the clearance, which holds for both of its level sets.
        if (std::holds_alternative<DeformingShape>(collider.shape)) placement.moves = true;
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
    placement.reach = reachOf(placement, colliders_->boundingBall(collider), dt_);
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
        const Nearness near = nearnessOf((*colliders_)[i].shape, local, radius, placement.endShare);
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
    if (!placement.moves) return outwardNormal(shape, position, 0.0, normal);
    if (!outwardNormal(shape, placement.end.toLocal(position), placement.endShare, normal)) return false;
    normal = placement.end.vectorToWorld(normal);
    return true;
}

bool PlacedColliders::wayOut(std::size_t collider, const Vec3d& position, Vec3d& direction, double& distance) const
{
    distance = 0.0;
    if (normalAt(collider, position, direction)) return true;
    const Placement& placement = placements_[collider];
    Vec3d way;
    if (!nearestOutsideOf((*colliders_)[collider].shape, placement.end.toLocal(position), way)) return false;
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
        deformationVelocity((*colliders_)[collider].shape, placement.end.toLocal(position), placement.endShare);
    return placement.velocity.at(position) + placement.end.vectorToWorld(deforming);
}

Vec3d PlacedColliders::carried(std::size_t collider, const Vec3d& position) const
{
    const Placement& placement = placements_[collider];
    if (!placement.moves) return position;
    const Vec3d local = placement.begin.toLocal(position);
    const Vec3d deforming = deformationVelocity((*colliders_)[collider].shape, local, placement.beginShare);
    return placement.end.toWorld(local + dt_ * deforming);
}

} // namespace vdbounce
