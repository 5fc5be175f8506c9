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
    std::uint64_t steps = 0;     ///< through so many, of the scene's first
    StepTally tally;
    double nsPerParticleStep = 0.0; ///< on all threads together
};

/// Takes some thousands of particles, evenly picked, through as many of `frames` frames after `firstFrame` as take half
/// a second, reading colliders included. Writes nothing, and changes neither particles nor colliders. Particles that
/// collide with each other or push colliders cost more than so few show: they are taken as if they did not. Throws
/// Interrupted.
Trial tryOut(const Scene& scene, SceneColliders& loader, const Particles& particles, const ParticleDefaults& defaults,
             int firstFrame, int frames, Progress& progress);

} // namespace vdbounce
