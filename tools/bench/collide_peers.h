// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/step.h"
#include "vdbounce/io/level_set_grid.h"
#include "vdbounce/particles/particles.h"

#include <functional>
#include <string>

namespace vdbounce::bench {

/// Another way to move the same particles, on as many threads as are allowed.
struct CollidePeer {
    std::string name;
    std::function<void(const Particles& start)> place; ///< puts its own particles where these are
    std::function<void(int steps)> advance;
};

/// The method of NanoVDB's collision example, in float, through its cached accessor: a particle that falls below y = 0
/// begins anew at `top`; one whose voxel is active and not positive goes back by that value along its way, and its
/// velocity is mirrored at the voxel's forward differences. One sweep over the particles a step, as there. No radius,
/// restitution, friction or clearance. Of `options` dt and gravity.
CollidePeer nanoCollision(const LevelSetGrid& grid, const StepOptions& options, double top);

/// What particles cost that meet nothing: v += g dt, x += dt (v before + v after) / 2, in double. One sweep over the
/// memory a step, or, at its best, each block of particles through all steps while it is in the cache.
CollidePeer gravityAndMove(const StepOptions& options);
CollidePeer gravityAndMoveInBlocks(const StepOptions& options);

} // namespace vdbounce::bench
