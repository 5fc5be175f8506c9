// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/collider.h"

#include <algorithm>
#include <limits>

namespace vdbounce {
namespace {

// A distance field's gradient has length 1. Well below that it says more about rounding and kinks than about the way
// out.
constexpr double kSmallestGradient = 1e-3;

// The distance to a collider without a surface.
constexpr double kNowhere = std::numeric_limits<double>::infinity();

struct FieldReach {
    double phi;
    double travel; // from here to phi = 0 at least, in units of phi
    double lipschitz;
};

FieldReach reachOf(const PlaneField& plane, const Vec3d& position)
{
    const double phi = plane.phi(position);
    return {phi, phi, 1.0};
}

FieldReach reachOf(const std::shared_ptr<const DistanceField>& field, const Vec3d& position)
{
    if (field->empty()) return {kNowhere, kNowhere, 1.0};
    const double phi = field->phi(position);
    return {phi, field->freeDistance(position, phi), field->lipschitz()};
}

FieldSample sampleOf(const PlaneField& plane, const Vec3d& position) { return plane.sample(position); }
FieldSample sampleOf(const std::shared_ptr<const DistanceField>& field, const Vec3d& position)
{
    return field->sample(position);
}

} // namespace

ColliderSet::ColliderSet(std::vector<Collider> colliders)
    : colliders_(std::move(colliders)), smallestVoxel_(std::numeric_limits<double>::infinity())
{
    for (const Collider& collider : colliders_) {
        if (const auto* field = std::get_if<std::shared_ptr<const DistanceField>>(&collider.shape)) {
            smallestVoxel_ = std::min(smallestVoxel_, (*field)->voxelSize());
        }
    }
}

Probe ColliderSet::probe(const Vec3d& position, double radius) const
{
    const double infinity = std::numeric_limits<double>::infinity();
    Probe probe{infinity, infinity, 0};
    for (std::size_t i = 0; i < colliders_.size(); ++i) {
        const FieldReach reach =
            std::visit([&](const auto& field) { return reachOf(field, position); }, colliders_[i].shape);
        const double gap = reach.phi - radius;
        if (gap < probe.gap) {
            probe.gap = gap;
            probe.collider = i;
        }
        probe.clearance = std::min(probe.clearance, std::max(0.0, reach.travel - radius) / reach.lipschitz);
    }
    return probe;
}

bool ColliderSet::normalAt(std::size_t collider, const Vec3d& position, Vec3d& normal) const
{
    const FieldSample sample =
        std::visit([&](const auto& field) { return sampleOf(field, position); }, colliders_[collider].shape);
    const double length = sample.gradient.norm();
    if (!(length > kSmallestGradient)) return false;
    normal = sample.gradient / length;
    return true;
}

bool ColliderSet::wayOut(std::size_t collider, const Vec3d& position, Vec3d& direction, double& distance) const
{
    distance = 0.0;
    if (normalAt(collider, position, direction)) return true;
    const auto* field = std::get_if<std::shared_ptr<const DistanceField>>(&colliders_[collider].shape);
    if (field == nullptr) return false; // a plane's gradient never vanishes
    const auto outside = (*field)->nearestOutside(position);
    if (!outside) return false;
    direction = *outside - position;
    distance = direction.norm();
    if (!(distance > 0.0)) return false;
    direction /= distance;
    return true;
}

} // namespace vdbounce
