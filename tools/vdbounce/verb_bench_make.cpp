// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_make.h"
#include "bench_report.h"
#include "command_text.h"
#include "progress_bar.h"

#include <memory>

namespace vdbounce::tool {
namespace {

struct BenchMakeArguments {
    bench::MakeBenchOptions options;
    std::string html;
};

std::string commandOf(const BenchMakeArguments& arguments)
{
    CommandText command("bench make");
    command.option("--repetitions", arguments.options.repetitions);
    return command.text();
}

void runBenchMake(const BenchMakeArguments& arguments, const CommonOptions& common)
{
    requirePage(arguments.html);
    const bench::MakeBenchOptions& options = arguments.options;
    bench::Cases cases;
    {
        ProgressBar progress(common, "bench make");
        cases = bench::benchMake(options, progress);
    }
    reportRun(common, {commandOf(arguments), casesJson(cases), casesText(cases)}, arguments.html);
}

} // namespace

void addBenchMake(CLI::App& bench, const CommonOptions& common)
{
    auto arguments = std::make_shared<BenchMakeArguments>();
    auto* make = bench.add_subcommand("make", "Shapes, CSG, blobs and redistancing against OpenVDB's");
    addRepetitions(*make, arguments->options.repetitions);
    addHtml(*make, arguments->html);
    make->footer("Example:\n  vdbounce bench make --repetitions 1");
    make->callback([arguments, &common] { runWith(common, [&] { runBenchMake(*arguments, common); }); });
}

} // namespace vdbounce::tool
