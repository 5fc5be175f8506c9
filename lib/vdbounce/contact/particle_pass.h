// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/contact/step.h"
#include "vdbounce/particles/particles.h"

#include <cstdint>

namespace vdbounce {

/// What a particle has whose file carries no such attribute.
struct ParticleDefaults {
    double radius = 0.0; ///< world units, >= 0
    double mass = 1.0;   ///< > 0
};

/// What one pass did.
struct PassReport {
    StepTally tally;
    std::uint64_t rejected = 0; ///< particles left as they came: not finite, or a negative radius or mass
};

/// Advances all particles by `steps` steps, in parallel.
///
/// Particles do not see each other, so each is taken through all its steps while it and the voxels around it are in
/// the cache. Results, sums included, have the same bits for any number of threads.
/// Needs particles.velocity (see Particles::ensureVelocity). Tells `progress` of particles done. Throws Interrupted,
/// with some particles advanced and others not.
PassReport advanceParticles(Particles& particles, const ColliderSet& colliders, const StepOptions& options,
                            const ParticleDefaults& defaults, int steps, Progress& progress = Progress::none());

/// Kinetic plus potential energy of all particles that can be stepped, m (v^2/2 - g.x), summed in fixed order.
double totalEnergy(const Particles& particles, const ParticleDefaults& defaults, const Vec3d& gravity);

} // namespace vdbounce
