// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/collider.h"
#include "vdbounce/contact/particle_pass.h"
#include "vdbounce/particles/particles.h"
#include "vdbounce/scene/scene.h"

namespace vdbounce {

/// Reads the files of a scene's colliders and makes them ready. A file that several colliders name is read once.
ColliderSet loadColliders(const Scene& scene);

/// What particles have that carry no attribute of their own; a radius in voxels needs the colliders.
ParticleDefaults particleDefaults(const Scene& scene, const ColliderSet& colliders);

/// Throws InputError when a particle is too large for a collider's narrow band: phi is not known beyond it, so touching
/// at phi = radius would go unnoticed. Names the band that would do.
void requireBandsForRadius(const Scene& scene, const ColliderSet& colliders, const Particles& particles,
                           const ParticleDefaults& defaults);

} // namespace vdbounce
