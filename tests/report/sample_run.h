// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vdbounce::test {

/// JSON like that of a run of `bench all`: 300 cases of its trade in three groups, costs and errors made up, some
/// errors zero, some missing, one name full of HTML; then 24 cases of collide, most compared with one of two peers, and
/// two cases of no kind without a peer.
std::string sampleRun();

/// The cases of each group of lookups and of the group of steps.
constexpr int kSampleLookups = 90;
constexpr int kSampleSteps = 120;

} // namespace vdbounce::test
