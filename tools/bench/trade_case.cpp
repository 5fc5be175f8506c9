// SPDX-License-Identifier: Apache-2.0
#include "bench/trade_case.h"

#include "bench/stopwatch.h"

#include "vdbounce/io/number_text.h"

#include <algorithm>

namespace vdbounce::bench {

double TradeCost::ns() const { return median(nsPerParticleStep); }

std::string TradeCase::name() const
{
    std::string text = group;
    if (settings.voxel > 0.0) text += ", voxel " + numberText(settings.voxel);
    text += std::string(", ") + nameOf(settings.field.lookup) + ", " + settings.normalName() + ", " +
            nameOf(settings.field.storage);
    if (settings.scheme) text += std::string(", ") + nameOf(*settings.scheme);
    if (settings.sweep) text += std::string(", sweep ") + nameOf(*settings.sweep);
    if (settings.dt) text += ", dt " + numberText(*settings.dt);
    return text;
}

void markPareto(std::vector<TradeCase>& cases)
{
    const auto beats = [](const TradeCase& a, const TradeCase& b) {
        const double costs[] = {a.cost.ns(), b.cost.ns()};
        const double errors[] = {a.errors.front().second, b.errors.front().second};
        return costs[0] <= costs[1] && errors[0] <= errors[1] && (costs[0] < costs[1] || errors[0] < errors[1]);
    };
    for (TradeCase& one : cases) {
        one.pareto = std::none_of(cases.begin(), cases.end(), [&](const TradeCase& other) {
            return other.group == one.group && beats(other, one);
        });
    }
}

} // namespace vdbounce::bench
