// SPDX-License-Identifier: Apache-2.0
#include "bench/trade_scene.h"
#include "bench/trade_shapes.h"
#include "bench_report.h"
#include "command_text.h"
#include "option_values.h"
#include "progress_bar.h"
#include "trade_report.h"

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

std::string commandOf(const BenchTradeArguments& arguments)
{
    CommandText command("bench trade");
    command.add(arguments.files);
    command.option("--dim", arguments.dim);
    command.option("--points", arguments.options.points);
    command.option("--shots", arguments.options.shots);
    if (arguments.options.frames > 0) command.option("--frames", arguments.options.frames);
    command.option("--repetitions", arguments.options.repetitions);
    return command.text();
}

void append(std::vector<bench::TradeCase> some, std::vector<bench::TradeCase>& cases)
{
    std::move(some.begin(), some.end(), std::back_inserter(cases));
}

std::vector<bench::TradeCase> tradeFile(const std::string& file, const BenchTradeArguments& arguments,
                                        Progress& progress)
{
    if (std::filesystem::path(file).extension() == ".toml") return bench::tradeScene(file, arguments.options, progress);
    const bench::TradeSubject subject =
        isMeshFile(file) ? bench::meshSubject(file, arguments.dim, progress) : bench::fieldSubject(file);
    return bench::tradeLookups(subject, arguments.options, progress);
}

void runBenchTrade(const BenchTradeArguments& arguments, const CommonOptions& common)
{
    requirePage(arguments.html, arguments.files);
    std::vector<bench::TradeCase> cases;
    {
        ProgressBar progress(common, "bench trade");
        if (arguments.files.empty()) append(bench::tradeShapes(arguments.options, progress), cases);
        for (const std::string& file : arguments.files) append(tradeFile(file, arguments, progress), cases);
    }
    bench::markPareto(cases);
    reportRun(common, {commandOf(arguments), tradeJson(cases), tradeText(cases)}, arguments.html);
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
    addHtml(*trade, arguments->html);
    trade->footer("Examples:\n  vdbounce bench trade bunny.obj --html trade.html\n"
                  "  vdbounce bench trade scene.toml --shots 500");
    trade->callback([arguments, &common] { runWith(common, [&] { runBenchTrade(*arguments, common); }); });
}

} // namespace vdbounce::tool
