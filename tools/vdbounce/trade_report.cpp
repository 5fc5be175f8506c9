// SPDX-License-Identifier: Apache-2.0
#include "trade_report.h"

#include "bench/stopwatch.h"

#include <algorithm>

namespace vdbounce::tool {
namespace {

Json range(const std::vector<double>& values)
{
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return {*least, *most};
}

Json toJson(const bench::TradeSettings& settings)
{
    Json json = {{"voxel", nullptr},
                 {"lookup", nameOf(settings.field.lookup)},
                 {"normal", settings.normalName()},
                 {"storage", nameOf(settings.field.storage)},
                 {"scheme", nullptr},
                 {"sweep", nullptr},
                 {"dt", nullptr}};
    if (settings.voxel > 0.0) json["voxel"] = settings.voxel;
    if (settings.scheme) json["scheme"] = nameOf(*settings.scheme);
    if (settings.sweep) json["sweep"] = nameOf(*settings.sweep);
    if (settings.dt) json["dt"] = *settings.dt;
    return json;
}

Json toJson(const bench::TradeCase& one)
{
    Json errors = Json::object();
    Json spread = {{"ns_per_particle_step", range(one.cost.nsPerParticleStep)},
                   {"build_seconds", range(one.cost.buildSeconds)}};
    for (const bench::TradeError& error : one.errors) {
        errors[error.name] = bench::median(error.values);
        spread[error.name] = range(error.values);
    }
    Json json = {{"name", one.name()},
                 {"unit", "ns"},
                 {"value", one.ns()},
                 {"group", one.group},
                 {"settings", toJson(one.settings)},
                 {"cost",
                  {{"ns_per_particle_step", one.ns()},
                   {"build_seconds", bench::median(one.cost.buildSeconds)},
                   {"bytes", one.cost.bytes}}},
                 {"error", errors},
                 {"spread", spread},
                 {"pareto", one.pareto}};
    if (one.settings.dt) json["cost"]["us_per_particle_second"] = one.price();
    return json;
}

} // namespace

Json tradeJson(const std::vector<bench::TradeCase>& cases)
{
    Json json = Json::array();
    for (const bench::TradeCase& one : cases) json.push_back(toJson(one));
    return json;
}

std::string tradeText(std::vector<bench::TradeCase> cases)
{
    std::stable_sort(cases.begin(), cases.end(), [](const auto& a, const auto& b) { return a.price() < b.price(); });
    std::vector<std::string> groups;
    for (const bench::TradeCase& one : cases) {
        if (std::find(groups.begin(), groups.end(), one.group) == groups.end()) groups.push_back(one.group);
    }
    std::string text =
        "choices that no other beats in both cost and error; --json has all " + std::to_string(cases.size());
    for (const std::string& group : groups) {
        for (const bench::TradeCase& one : cases) {
            if (one.group != group || !one.pareto) continue;
            text += "\n" + one.name() + ": " + rounded(one.ns()) + " ns, " + one.errors.front().name + " " +
                    rounded(one.error());
        }
    }
    return text;
}

} // namespace vdbounce::tool
