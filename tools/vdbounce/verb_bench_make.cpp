// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_blobs.h"
#include "bench/bench_csg.h"
#include "bench/bench_redistance.h"
#include "bench/bench_shapes.h"
#include "bench_report.h"
#include "progress_bar.h"

#include <memory>

namespace vdbounce::tool {
namespace {

void runBenchMake(const bench::MakeBenchOptions& options, const CommonOptions& common)
{
    bench::Cases cases;
    {
        ProgressBar progress(common, "bench make");
        append(cases, bench::benchShapes(options, progress));
        append(cases, bench::benchCsg(options, progress));
        append(cases, bench::benchBlobs(options, progress));
        append(cases, bench::benchRedistance(options, progress));
    }
    reportCases(common, cases);
}

} // namespace

void addBenchMake(CLI::App& bench, const CommonOptions& common)
{
    auto options = std::make_shared<bench::MakeBenchOptions>();
    auto* make = bench.add_subcommand("make", "Shapes, CSG, blobs and redistancing against OpenVDB's");
    addRepetitions(*make, options->repetitions);
    make->footer("Example:\n  vdbounce bench make --repetitions 1");
    make->callback([options, &common] { runWith(common, [&] { runBenchMake(*options, common); }); });
}

} // namespace vdbounce::tool
