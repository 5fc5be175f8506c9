// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report.h"

#include "vdbounce/scene/explain.h"
#include "vdbounce/scene/run.h"

/// @file
/// What collide prints: of a run, or of what a run would do.

namespace vdbounce::tool {

void reportRun(const RunReport& run, const CommonOptions& common);
void reportExplanation(const Explanation& plan, const CommonOptions& common);

} // namespace vdbounce::tool
