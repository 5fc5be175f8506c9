// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/particles/particles.h"
#include "vdbounce/render/camera.h"
#include "vdbounce/render/surface_buffer.h"

#include <vector>

namespace vdbounce {

/// How particles look: one radius and colour each, in the order of the particles.
struct ParticleLook {
    std::vector<float> radius;  ///< world units
    std::vector<Colour> albedo; ///< linear
};

/// Colours by speed, from slow to the speed that nine tenths stay under; radii as asked, as carried, or to suit the
/// number.
ParticleLook lookOf(const Particles& particles, double askedRadius, const Box& frame);

/// Draws particles as small spheres wherever they are in front of what the buffer holds.
void splatParticles(const Particles& particles, const ParticleLook& look, const Camera& camera, SurfaceBuffer& buffer);

} // namespace vdbounce
