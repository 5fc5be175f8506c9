// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "description.h"
#include "level_set_survey.h"
#include "level_set_verdict.h"

namespace vdbounce::tool {

Description describeLevelSet(const LevelSetSurvey& survey, const Verdict& verdict);

} // namespace vdbounce::tool
