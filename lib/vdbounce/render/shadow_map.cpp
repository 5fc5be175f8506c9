// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/render/shadow_map.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vdbounce {
namespace {

constexpr int kSize = 2048;        // texels a side
constexpr int kSoftTexels = 3;     // half width of the softening
constexpr double kBiasRadii = 2.0; // particles do not shade themselves or those they lie among

} // namespace

ShadowMap::ShadowMap(const Particles& particles, const ParticleLook& look, const Vec3d& towardsLight, const Box& frame)
    : towardsLight_(towardsLight), centre_(frame.centre()), bias_(0.0),
      height_(std::size_t(kSize) * kSize, -std::numeric_limits<float>::infinity())
{
    right_ = towardsLight.unitOrthogonal();
    up_ = towardsLight.cross(right_);
    texelsPerUnit_ = kSize / std::max(1e-30, frame.size().norm());
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const Vec3d offset = particles.position[i] - centre_;
        if (!offset.allFinite()) continue;
        bias_ = std::max(bias_, kBiasRadii * double(look.radius[i]));
        const double u = offset.dot(right_) * texelsPerUnit_ + 0.5 * kSize;
        const double v = offset.dot(up_) * texelsPerUnit_ + 0.5 * kSize;
        const double reach = std::min(64.0, std::max(0.5, look.radius[i] * texelsPerUnit_));
        if (u + reach < 0.0 || v + reach < 0.0 || u - reach > kSize || v - reach > kSize) continue;
        const float height = float(offset.dot(towardsLight));
        for (int y = std::max(0, int(v - reach)); y <= std::min(kSize - 1, int(v + reach)); ++y) {
            for (int x = std::max(0, int(u - reach)); x <= std::min(kSize - 1, int(u + reach)); ++x) {
                float& texel = height_[std::size_t(y) * kSize + std::size_t(x)];
                texel = std::max(texel, height);
            }
        }
    }
}

double ShadowMap::lightReaching(const Vec3d& point) const
{
    const Vec3d offset = point - centre_;
    const int u = int(std::floor(offset.dot(right_) * texelsPerUnit_ + 0.5 * kSize));
    const int v = int(std::floor(offset.dot(up_) * texelsPerUnit_ + 0.5 * kSize));
    const auto height = float(offset.dot(towardsLight_) + bias_);
    int lit = 0;
    int all = 0;
    for (int y = v - kSoftTexels; y <= v + kSoftTexels; ++y) {
        for (int x = u - kSoftTexels; x <= u + kSoftTexels; ++x) {
            ++all;
            if (x < 0 || y < 0 || x >= kSize || y >= kSize ||
                height_[std::size_t(y) * kSize + std::size_t(x)] <= height)
                ++lit;
        }
    }
    return double(lit) / all;
}

} // namespace vdbounce
