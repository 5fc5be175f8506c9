// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/particles/particles.h"
#include "vdbounce/scene/scene.h"
#include "vdbounce/scene/scene_colliders.h"

#include <cstdint>

namespace vdbounce {

/// What a scene's steps cost, from a few of its particles that were taken ahead of all others.
struct Trial {
    std::uint64_t particles = 0; ///< that were taken
    int frames = 0;              ///< through so many, at least one, of the scene's
    StepTally tally;
    double nsPerParticleStep = 0.0; ///< on all threads together
};

/// Takes some thousands of particles, evenly picked, through as many frames as take half a second. Writes nothing, and
/// changes neither particles nor colliders. Particles that collide with each other or push colliders cost more than
/// so few show: they are taken as if they did not.
Trial tryOut(const Scene& scene, SceneColliders& loader, const Particles& particles, const ParticleDefaults& defaults);

} // namespace vdbounce
