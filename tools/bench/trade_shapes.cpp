// SPDX-License-Identifier: Apache-2.0
#include "bench/trade_shapes.h"

#include "bench/trade_steps.h"

#include <iterator>

namespace vdbounce::bench {

std::vector<TradeCase> tradeShapes(const TradeOptions& options, Progress& progress)
{
    std::vector<TradeCase> cases;
    const auto add = [&](std::vector<TradeCase> some) {
        std::move(some.begin(), some.end(), std::back_inserter(cases));
    };
    for (const TradeSubject& subject : analyticSubjects(progress)) add(tradeLookups(subject, options, progress));
    add(tradeShots(options, progress));
    add(tradeSlides(options, progress));
    return cases;
}

} // namespace vdbounce::bench
