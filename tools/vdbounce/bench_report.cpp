// SPDX-License-Identifier: Apache-2.0
#include "bench_report.h"

#include "bench/machine.h"

namespace vdbounce::tool {
namespace {

Json toJson(const bench::Case& result)
{
    Json json = {{"name", result.name}, {"unit", result.unit}, {"value", result.value}};
    if (result.peer) {
        json["peer"] = {{"name", result.peer->name}, {"value", result.peer->value}};
        json["ratio"] = result.ratio();
    }
    return json;
}

std::string toText(const bench::Case& result)
{
    std::string text = result.name + ": " + rounded(result.value) + " " + result.unit;
    if (result.peer) {
        text += "; " + result.peer->name + " " + rounded(result.peer->value) + ", ratio " + rounded(result.ratio());
    }
    return text;
}

} // namespace

Json casesJson(const bench::Cases& cases)
{
    Json json = Json::array();
    for (const bench::Case& result : cases) json.push_back(toJson(result));
    return json;
}

std::string casesText(const bench::Cases& cases)
{
    std::string text;
    for (const bench::Case& result : cases) text += (text.empty() ? "" : "\n") + toText(result);
    return text;
}

void reportCases(const CommonOptions& common, const bench::Cases& cases)
{
    reportCases(common, cases, casesText(cases));
}

void reportCases(const CommonOptions& common, const bench::Cases& cases, const std::string& text)
{
    const std::string machine = bench::machineText();
    report(common, {{"machine", machine}, {"cases", casesJson(cases)}}, machine + "\n" + text);
}

void append(bench::Cases& all, const bench::Cases& cases) { all.insert(all.end(), cases.begin(), cases.end()); }

void addRepetitions(CLI::App& verb, int& repetitions)
{
    verb.add_option("--repetitions", repetitions, "Runs, of which the median is printed")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str()
        ->type_name("N");
}

} // namespace vdbounce::tool
