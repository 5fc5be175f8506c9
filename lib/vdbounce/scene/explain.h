// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/scene/accuracy_plan.h"
#include "vdbounce/scene/run.h"
#include "vdbounce/scene/trial.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vdbounce {

/// What a run of a scene would do and take.
struct Explanation {
    std::vector<std::string> lines; ///< in words
    std::uint64_t particles = 0;
    std::uint64_t steps = 0;              ///< of each
    std::uint64_t bytes = 0;              ///< of the program at its largest
    Trial trial;                          ///< what the steps cost
    std::optional<double> seconds;        ///< of stepping; nothing where particles see each other or move colliders
    std::optional<AccuracyPlan> accuracy; ///< where the scene has a maxError
};

/// Reads what the scene names, tries its steps out on some particles (see Trial), and writes nothing but what lookups
/// are off by where the scene has a maxError. Throws as runScene() does before its first step.
Explanation explainScene(const Scene& scene, const RunOptions& options, Progress& progress = Progress::none());

} // namespace vdbounce
