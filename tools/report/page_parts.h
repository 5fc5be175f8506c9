// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

/// @file
/// The page in three parts, between which command and run are put. assemble_page.cmake makes them when building.

namespace vdbounce::report {

extern const std::string kPageBeforeCommand;
extern const std::string kPageBeforeRun;
extern const std::string kPageAfterRun;

} // namespace vdbounce::report
