// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"
#include "vdbounce/render/particle_splat.h"

#include <vector>

namespace vdbounce {

/// The shadows that particles throw: depths seen from a far light.
class ShadowMap {
public:
    /// `towardsLight` is a unit vector; `frame` is what the picture shows.
    ShadowMap(const Particles& particles, const ParticleLook& look, const Vec3d& towardsLight, const Box& frame);

    /// The share of the light that particles let through to `point`, 0 to 1, softened over a few texels.
    double lightReaching(const Vec3d& point) const;

private:
    Vec3d right_;
    Vec3d up_;
    Vec3d towardsLight_;
    Vec3d centre_;
    double texelsPerUnit_;
    double bias_;
    std::vector<float> height_; // along towardsLight, of the particle nearest to the light
};

} // namespace vdbounce
