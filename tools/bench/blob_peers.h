// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/io/level_set_grid.h"
#include "vdbounce/particles/particles.h"

namespace vdbounce::bench {

constexpr const char* kParticlesToLevelSet = "OpenVDB ParticlesToLevelSet";

/// The same with OpenVDB's ParticlesToLevelSet::rasterizeSpheres on as many threads as are allowed, with no particle
/// too small or too large for it, and finalize() with pruning. Grain sizes of 1, 64 and 4096 are equally fast, and
/// so is 0, which uses one thread.
LevelSetGrid particlesToLevelSet(const Particles& particles, double voxelSize, double halfWidthVx);

/// Largest difference between a grid's active values and the least of |x - c| - r over all particles, double precision,
/// at `count` active voxels, in voxels.
double largestSphereErrorVx(const LevelSetGrid& grid, const Particles& particles, std::size_t count);

} // namespace vdbounce::bench
