// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/implicit/ball_list.h"
#include "vdbounce/implicit/sphere_leaf.h"
#include "vdbounce/io/level_set_grid.h"

#include <cstdint>
#include <string>

namespace vdbounce {

/// The level set of a union of spheres, given in index space (voxel centres at whole coordinates): phi = min |x - c| -
/// r, world units, rounded to float once, see measureSphereLeaf(). Outside that is the signed distance. Inside, where
/// spheres overlap, the surface may be farther than |phi| says, never nearer; redistance() makes it exact to its own
/// error.
///
/// Active where |phi| is below the half width; beyond it, the half width with the sign, as leaves and tiles. A sphere
/// that passes between voxel centres leaves positive values and no surface.
///
/// The same bits for any number of threads. Throws UsageError for more than `maxLeaves` leaves, Interrupted.
LevelSetGrid sphereUnion(BallList balls, const SphereBand& band, const std::string& name, std::uint64_t maxLeaves,
                         Progress& progress);

} // namespace vdbounce
