// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/scene/scene.h"

#include <optional>

/// @file
/// `max_error`: the cheapest way to look level sets up that is exact enough for a scene.

namespace vdbounce {

struct AccuracyPlan {
    FieldOptions chosen;
    double error = 0.0;    ///< what it is off by: the largest of all level sets, world units
    double measured = 0.0; ///< the same on another sample than the one that it was chosen by
    double voxel = 0.0;    ///< the smallest of all level sets, world units; 0 where the scene has none

    double measuredVx() const { return voxel > 0.0 ? measured / voxel : 0.0; }
};

/// The fastest choice whose error stays within the scene's maxError in each of its level sets (of sequences: in the
/// first of their files), in the sample that it is chosen by and in another, and whose fields fit into a quarter of the
/// machine's memory where one does. Errors are those of LookupErrors, and count between the level set and its surface
/// only: the motion in between two frames of a sequence, and the steps, have their own. Nothing where the scene has no
/// maxError.
///
/// The order of choices by cost is that of bench trade rather than timed here, so that the results of a scene do not
/// depend on what else a machine does.
///
/// Throws ToleranceError where no choice is exact enough, naming what can be reached and the voxel's size that would
/// do; UsageError for a maxError in voxels where there are none. Cost: some tenths of a second a file.
std::optional<AccuracyPlan> planAccuracy(const Scene& scene);

/// The scene with the accuracy that its maxError led to in place of both.
Scene withAccuracy(const Scene& scene, const AccuracyPlan& plan);

} // namespace vdbounce
