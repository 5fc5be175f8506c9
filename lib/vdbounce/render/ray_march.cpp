// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/render/ray_march.h"

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

constexpr double kArrivedVx = 0.01; // closer than this counts as on the surface
constexpr double kShortestStepVx = 0.02;
constexpr int kMaxSteps = 2000;    // a grazing ray through a grid of 1000 voxels
constexpr double kPenumbra = 12.0; // sharpness of shadows: the light's angular radius is about a twelfth
constexpr int kOpennessSteps = 5;

} // namespace

std::optional<double> marchToSurface(const DistanceField& field, const Vec3d& origin, const Vec3d& direction,
                                     double begin, double end)
{
    const Span span = clipToBox(field.worldBox(), origin, direction, {begin, end});
    const double perUnit = 1.0 / (direction.norm() * field.lipschitz());
    const double arrived = kArrivedVx * field.voxelSize();
    const double shortest = kShortestStepVx * field.voxelSize() / direction.norm();
    double t = span.begin;
    for (int step = 0; step < kMaxSteps && t <= span.end; ++step) {
        const double phi = field.phi(origin + t * direction);
        if (phi < arrived) return t;
        t += std::max(phi * perUnit, shortest);
    }
    return std::nullopt;
}

double lightReaching(const DistanceField& field, const Vec3d& point, const Vec3d& towardsLight)
{
    const Span span = clipToBox(field.worldBox(), point, towardsLight, {0.0, 1e30});
    double light = 1.0;
    double t = std::max(span.begin, field.voxelSize());
    for (int step = 0; step < kMaxSteps && t < span.end; ++step) {
        const double phi = field.phi(point + t * towardsLight);
        if (phi <= 0.0) return 0.0;
        // The background is a lower bound on the distance; only values within the band tell how close the ray passes.
        if (phi < 0.99 * field.background()) light = std::min(light, kPenumbra * phi / t);
        t += std::max(0.7 * phi, 0.2 * field.voxelSize());
    }
    return light;
}

double openness(const DistanceField& field, const Vec3d& point, const Vec3d& normal, double reach)
{
    double blocked = 0.0;
    double weight = 0.6;
    for (int i = 1; i <= kOpennessSteps; ++i) {
        const double distance = std::min(reach, field.background()) * i / kOpennessSteps;
        blocked += weight * std::max(0.0, distance - field.phi(point + distance * normal)) / distance;
        weight *= 0.7;
    }
    return std::clamp(1.0 - blocked, 0.0, 1.0);
}

} // namespace vdbounce
