// SPDX-License-Identifier: Apache-2.0
#include "bench/trade_case.h"

#include "bench/stopwatch.h"

#include "vdbounce/io/number_text.h"

#include <algorithm>

namespace vdbounce::bench {

double TradeCase::ns() const { return median(cost.nsPerParticleStep); }

double TradeCase::price() const
{
    constexpr double kMicrosecond = 1e-3; // in nanoseconds
    return settings.dt ? ns() * kMicrosecond / *settings.dt : ns();
}

double TradeCase::error() const { return median(errors.front().values); }

void TradeCase::addErrors(const std::vector<std::pair<std::string, double>>& found)
{
    errors.resize(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        errors[i].name = found[i].first;
        errors[i].values.push_back(found[i].second);
    }
}

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
        const bool better = a.price() < b.price() || a.error() < b.error();
        return better && a.price() <= b.price() && a.error() <= b.error();
    };
    for (TradeCase& one : cases) {
        one.pareto = std::none_of(cases.begin(), cases.end(), [&](const TradeCase& other) {
            return other.group == one.group && beats(other, one);
        });
    }
}

} // namespace vdbounce::bench
