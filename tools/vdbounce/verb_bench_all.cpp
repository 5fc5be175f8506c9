// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_collide.h"
#include "bench/bench_field.h"
#include "bench/bench_make.h"
#include "bench/bench_mesh.h"
#include "bench/trade_shapes.h"
#include "bench_report.h"
#include "command_text.h"
#include "progress_bar.h"
#include "trade_report.h"

#include "vdbounce/io/mesh_file.h"

#include <filesystem>
#include <functional>
#include <memory>

namespace vdbounce::tool {
namespace {

// The mesh that comes with the sources, and one that ./dev data fetches.
constexpr const char* kBunny = "data/bunny.obj";
constexpr const char* kDragon = "data/fetched/dragon_vrip.ply";

// What each kind measures by itself, less of it, so that all together take minutes.
constexpr std::uint64_t kPoints = 2'000'000;
constexpr std::uint64_t kParticles = 1'000'000;
constexpr int kBunnyDim = 512;
constexpr int kDragonDim = 512;

struct BenchAllArguments {
    int repetitions = 3;
    std::string html;
};

std::string commandOf(const BenchAllArguments& arguments)
{
    CommandText command("bench all");
    command.option("--repetitions", arguments.repetitions);
    return command.text();
}

struct Kind {
    const char* name;
    std::function<bench::Cases(int repetitions, Progress&)> measure;
};

bench::Cases benchMeshes(int repetitions, Progress& progress)
{
    bench::Cases cases;
    const auto add = [&](const char* file, int dim) {
        if (!std::filesystem::exists(file)) return; // told by warnOfMissing()
        const std::string name = std::filesystem::path(file).filename().string();
        append(cases, bench::casesOf(bench::benchMesh(name, readMesh(file), {dim, 3.0, repetitions}, progress)));
    };
    add(kBunny, kBunnyDim);
    add(kDragon, kDragonDim);
    return cases;
}

void warnOfMissing(const CommonOptions& common)
{
    for (const char* file : {kBunny, kDragon}) {
        if (!std::filesystem::exists(file))
            warn(common, std::string(file) + " is left out: it is not here; run in the sources, ./dev data fetches it");
    }
}

bench::Cases benchCollisions(int repetitions, Progress& progress)
{
    bench::CollideBenchOptions options;
    options.repetitions = repetitions;
    options.particles = kParticles;
    bench::Cases cases = bench::benchColumn(options, progress);
    if (std::filesystem::exists(kBunny))
        append(cases, bench::benchMeshBox("bunny", readMesh(kBunny), options, progress));
    return cases;
}

bench::Cases benchLookups(int repetitions, Progress& progress)
{
    bench::FieldBenchOptions options;
    options.repetitions = repetitions;
    options.points = {kPoints};
    return bench::benchField(bench::sphereSubject(), options, progress);
}

bench::Cases benchMaking(int repetitions, Progress& progress) { return bench::benchMake({repetitions}, progress); }

const Kind kKinds[] = {
    {"field", benchLookups}, {"mesh", benchMeshes}, {"make", benchMaking}, {"collide", benchCollisions}};

std::vector<bench::TradeCase> trade(int repetitions, Progress& progress)
{
    bench::TradeOptions options;
    options.repetitions = repetitions;
    std::vector<bench::TradeCase> cases = bench::tradeShapes(options, progress);
    bench::markPareto(cases);
    return cases;
}

void runBenchAll(const BenchAllArguments& arguments, const CommonOptions& common)
{
    requirePage(arguments.html);
    warnOfMissing(common);
    Json cases = Json::array();
    std::string text;
    const auto add = [&](const char* kind, const Json& some, const std::string& words) {
        for (Json one : some) {
            one["kind"] = kind;
            cases.push_back(one);
        }
        text += (text.empty() ? "\n" : "\n\n") + std::string(kind) + "\n" + words;
    };
    for (const Kind& kind : kKinds) {
        ProgressBar progress(common, std::string("bench ") + kind.name);
        const bench::Cases found = kind.measure(arguments.repetitions, progress);
        add(kind.name, casesJson(found), casesText(found));
    }
    ProgressBar progress(common, "bench trade");
    const std::vector<bench::TradeCase> found = trade(arguments.repetitions, progress);
    add("trade", tradeJson(found), tradeText(found));
    reportRun(common, {commandOf(arguments), cases, text}, arguments.html);
}

} // namespace

void addBenchAll(CLI::App& bench, const CommonOptions& common)
{
    auto arguments = std::make_shared<BenchAllArguments>();
    auto* all = bench.add_subcommand("all", "Some of everything, in under ten minutes on two cores");
    addRepetitions(*all, arguments->repetitions);
    addHtml(*all, arguments->html);
    all->footer("Example:\n  vdbounce bench all --json");
    all->callback([arguments, &common] { runWith(common, [&] { runBenchAll(*arguments, common); }); });
}

} // namespace vdbounce::tool
