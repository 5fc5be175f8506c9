// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/particles/points_voxel.h"

#include "vdbounce/base/voxel_limits.h"

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

constexpr std::size_t kSamples = 4096;     // enough to place the 5 % quantiles within a percent
constexpr double kTrimmed = 0.05;          // at each end
constexpr double kParticlesPerVoxel = 8.0; // OpenVDB's advice for points grids
constexpr double kDefaultVoxel = 1.0;
constexpr double kSmallestExponent = -16.0; // the first power of two above kSmallestVoxel
constexpr double kLargestExponent = 100.0;  // so that positions relative to a voxel stay floats

// The box of the middle nine tenths of evenly spaced samples, axis by axis; its sides are 0 for fewer than two
// particles.
Vec3d trimmedExtent(const Particles& particles)
{
    const std::size_t stride = std::max<std::size_t>(1, particles.size() / kSamples);
    Vec3d extent = Vec3d::Zero();
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> values;
        for (std::size_t i = 0; i < particles.size(); i += stride) {
            if (std::isfinite(particles.position[i][axis])) values.push_back(particles.position[i][axis]);
        }
        if (values.size() < 2) continue;
        std::sort(values.begin(), values.end());
        const auto at = [&](double quantile) {
            return values[static_cast<std::size_t>(quantile * double(values.size() - 1))];
        };
        extent[axis] = at(1.0 - kTrimmed) - at(kTrimmed);
    }
    return extent;
}

} // namespace

double pointsVoxelSize(const Particles& particles)
{
    const Vec3d extent = trimmedExtent(particles);
    const double largest = extent.maxCoeff();
    double size = kDefaultVoxel;
    if (largest > 0.0) {
        // Sides much thinner than the longest are layers, not volumes: they count as at least one voxel thick.
        const Vec3d sides = extent.cwiseMax(largest * 1e-3);
        size = std::cbrt(sides.x()) * std::cbrt(sides.y()) * std::cbrt(sides.z()) *
               std::cbrt(kParticlesPerVoxel / double(particles.size()));
    }
    double farthest = 0.0;
    const Box box = boundingBox(particles);
    if (!box.empty()) farthest = std::max(box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff());
    size = std::max(size, farthest / kFarthestVoxel);
    return std::exp2(std::clamp(std::ceil(std::log2(size)), kSmallestExponent, kLargestExponent));
}

} // namespace vdbounce
