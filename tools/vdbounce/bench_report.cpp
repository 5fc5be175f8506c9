// SPDX-License-Identifier: Apache-2.0
#include "bench_report.h"

#include "bench/machine.h"
#include "option_values.h"
#include "report/report_page.h"

#include "vdbounce/base/error.h"

#include <filesystem>
#include <utility>

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

void requirePage(const std::string& html, const std::vector<std::string>& inputs)
{
    if (html.empty()) return;
    requireOutput(html, {"html"}, inputs);
    const std::filesystem::path folder = std::filesystem::path(html).parent_path();
    if (!folder.empty() && !std::filesystem::is_directory(folder))
        throw UsageError(html, "lies in a folder that does not exist", "make the folder first");
    if (!report::hasReportPage()) report::writeReportPage("", "", html); // tells what this build lacks
}

void reportRun(const CommonOptions& common, BenchRun run, const std::string& html)
{
    if (common.threads > 0) run.command += " --threads " + std::to_string(common.threads);
    const std::string machine = bench::machineText();
    const Json json = {{"machine", machine}, {"command", run.command}, {"cases", std::move(run.cases)}};
    if (!html.empty()) {
        // Names of files need not be UTF-8.
        const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
        report::writeReportPage(text, run.command, html);
    }
    report(common, json, machine + "\n" + run.text);
}

void append(bench::Cases& all, const bench::Cases& cases) { all.insert(all.end(), cases.begin(), cases.end()); }

void addRepetitions(CLI::App& verb, int& repetitions)
{
    verb.add_option("--repetitions", repetitions, "Runs, of which the median is printed")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str()
        ->type_name("N");
}

void addHtml(CLI::App& verb, std::string& html)
{
    verb.add_option("--html", html, "Write a page with charts and tables of the run, which opens from disk")
        ->type_name("REPORT.html");
}

} // namespace vdbounce::tool
