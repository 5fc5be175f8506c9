// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/trade_lookups.h"

namespace vdbounce::bench {

/// All that is measured where no file is named: lookups in shapes by formula, shots and slides.
std::vector<TradeCase> tradeShapes(const TradeOptions& options, Progress& progress);

} // namespace vdbounce::bench
