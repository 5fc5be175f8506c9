// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/trade_case.h"
#include "report.h"

#include <string>
#include <vector>

/// @file
/// What bench trade found, in the forms in which it is told.

namespace vdbounce::tool {

/// A list of the cases, with medians as values and the least and the most of the repetitions as spread.
Json tradeJson(const std::vector<bench::TradeCase>& cases);

/// Of each group those that nothing beats, the cheapest first.
std::string tradeText(std::vector<bench::TradeCase> cases);

} // namespace vdbounce::tool
