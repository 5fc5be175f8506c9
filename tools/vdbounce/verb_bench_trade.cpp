// SPDX-License-Identifier: Apache-2.0
#include "bench/machine.h"
#include "bench/trade_scene.h"
#include "bench/trade_steps.h"
#include "bench_report.h"
#include "option_values.h"
#include "progress_bar.h"
#include "report.h"
#include "report/report_page.h"
#include "trade_report.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/mesh_file.h"

#include <algorithm>
#include <filesystem>
#include <memory>

namespace vdbounce::tool {
namespace {

struct BenchTradeArguments {
    std::vector<std::string> files;
    int dim = 128;
    bench::TradeOptions options;
    std::string html;
};

// That repeats the run.
std::string commandOf(const BenchTradeArguments& arguments)
{
    const bench::TradeOptions& options = arguments.options;
    std::string text = "vdbounce bench trade";
    for (const std::string& file : arguments.files) text += " " + file;
    text += " --dim " + std::to_string(arguments.dim) + " --points " + std::to_string(options.points) + " --shots " +
            std::to_string(options.shots);
    if (options.frames > 0) text += " --frames " + std::to_string(options.frames);
    return text + " --repetitions " + std::to_string(options.repetitions);
}

void append(std::vector<bench::TradeCase> some, std::vector<bench::TradeCase>& cases)
{
    std::move(some.begin(), some.end(), std::back_inserter(cases));
}

std::vector<bench::TradeCase> tradeShapes(const bench::TradeOptions& options, Progress& progress)
{
    std::vector<bench::TradeCase> cases;
    for (const bench::TradeSubject& subject : bench::analyticSubjects(progress))
        append(bench::tradeLookups(subject, options, progress), cases);
    append(bench::tradeShots(options, progress), cases);
    append(bench::tradeSlides(options, progress), cases);
    return cases;
}

std::vector<bench::TradeCase> tradeFile(const std::string& file, const BenchTradeArguments& arguments,
                                        Progress& progress)
{
    if (std::filesystem::path(file).extension() == ".toml") return bench::tradeScene(file, arguments.options, progress);
    const bench::TradeSubject subject =
        isMeshFile(file) ? bench::meshSubject(file, arguments.dim, progress) : bench::fieldSubject(file);
    return bench::tradeLookups(subject, arguments.options, progress);
}

// Before minutes of measuring.
void requirePage(const BenchTradeArguments& arguments)
{
    if (arguments.html.empty()) return;
    requireOutput(arguments.html, {"html"}, arguments.files);
    const std::filesystem::path folder = std::filesystem::path(arguments.html).parent_path();
    if (!folder.empty() && !std::filesystem::is_directory(folder))
        throw UsageError(arguments.html, "lies in a folder that does not exist", "make the folder first");
    if (!report::hasReportPage()) report::writeReportPage("", "", arguments.html); // tells what this build lacks
}

void runBenchTrade(const BenchTradeArguments& arguments, const CommonOptions& common)
{
    requirePage(arguments);
    std::vector<bench::TradeCase> cases;
    {
        ProgressBar progress(common, "bench trade");
        if (arguments.files.empty()) append(tradeShapes(arguments.options, progress), cases);
        for (const std::string& file : arguments.files) append(tradeFile(file, arguments, progress), cases);
    }
    bench::markPareto(cases);
    Json json = {{"machine", bench::machineText()}, {"command", commandOf(arguments)}, {"cases", tradeJson(cases)}};
    if (!arguments.html.empty()) report::writeReportPage(json.dump(), commandOf(arguments), arguments.html);
    report(common, json, json["machine"].get<std::string>() + "\n" + tradeText(cases));
}

} // namespace

void addBenchTrade(CLI::App& bench, const CommonOptions& common)
{
    auto arguments = std::make_shared<BenchTradeArguments>();
    auto* trade = bench.add_subcommand("trade", "What each choice of speed costs in accuracy");
    trade->add_option("FILE", arguments->files,
                      "Level sets, .vdb, meshes, or scenes, .toml: every lookup and every way to step against the "
                      "finest of both; without any shapes with known answers, and steps");
    trade->add_option("--dim", arguments->dim, "Voxels on a mesh's longest side, and half and a quarter as many")
        ->check(CLI::Range(8, 4096))
        ->capture_default_str()
        ->type_name("N");
    trade->add_option("--points", arguments->options.points, "Points to look up")
        ->check(CLI::Range(std::size_t(100), std::size_t(100'000'000)))
        ->capture_default_str()
        ->type_name("N");
    trade
        ->add_option("--shots", arguments->options.shots,
                     "Particles to step; of a scene's own at most so many, evenly picked")
        ->check(CLI::Range(std::size_t(10), std::size_t(10'000'000)))
        ->capture_default_str()
        ->type_name("N");
    trade
        ->add_option("--frames", arguments->options.frames,
                     "Frames of a scene to run, at most (default: those of its first second)")
        ->check(CLI::Range(1, 1'000'000'000))
        ->type_name("N");
    addRepetitions(*trade, arguments->options.repetitions);
    trade
        ->add_option("--html", arguments->html,
                     "Write a page with the curves of error over cost, which opens from disk")
        ->type_name("REPORT.html");
    trade->footer("Examples:\n  vdbounce bench trade bunny.obj --html trade.html\n"
                  "  vdbounce bench trade scene.toml --shots 500");
    trade->callback([arguments, &common] { runWith(common, [&] { runBenchTrade(*arguments, common); }); });
}

} // namespace vdbounce::tool
