// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vdbounce::test {

/// JSON like that of a run of `bench trade`: 300 cases in three groups, costs and errors made up, some errors zero,
/// some missing, one name full of HTML.
std::string sampleRun();

/// The cases of each group of lookups and of the group of steps.
constexpr int kSampleLookups = 90;
constexpr int kSampleSteps = 120;

} // namespace vdbounce::test
