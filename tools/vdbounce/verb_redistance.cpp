// SPDX-License-Identifier: Apache-2.0
#include "band_arguments.h"
#include "progress_bar.h"
#include "report.h"
#include "signals.h"
#include "stopwatch.h"
#include "voxel_text.h"

#include "vdbounce/implicit/redistance.h"
#include "vdbounce/io/grid_file.h"

#include <memory>

namespace vdbounce::tool {
namespace {

// Half of full density, where fog made of a level set has the surface.
constexpr double kFogIso = 0.5;

const std::map<std::string, Inside> kSides = {{"below", Inside::Below}, {"above", Inside::Above}};

struct RedistanceArguments {
    std::string input;
    std::string output;
    std::string grid;
    std::optional<double> iso;
    std::optional<Inside> inside;
    BandArguments band;
    RedistanceOptions options;
    bool half = false;
};

RedistanceOptions optionsFor(const RedistanceArguments& a, const ScalarGrid& grid)
{
    RedistanceOptions options = a.options;
    const bool fog = isFogVolume(grid);
    options.inside = a.inside ? *a.inside : (fog ? Inside::Above : Inside::Below);
    options.iso = a.iso ? *a.iso : (fog ? kFogIso : 0.0);
    options.exterior = a.band.outside();
    options.interior = a.band.inside();
    return options;
}

void runRedistance(const RedistanceArguments& a, const CommonOptions& common)
{
    requireOutput(a.output, {"vdb"}, {a.input});
    requireNoClash(a.band, "vdbounce redistance");
    endAtOnceWhenInterrupted(); // all that is written is written at the end
    Stopwatch watch;
    const ScalarGrid implicit = readScalarGrid(a.input, a.grid);
    const double readSeconds = watch.lap();
    LevelSetGrid result;
    {
        ProgressBar progress(common, "redistancing");
        result = redistance(implicit, optionsFor(a, implicit), progress);
    }
    const double buildSeconds = watch.lap();
    GridWriteOptions write;
    write.half = a.half;
    writeLevelSet(result, a.output, write);
    const double writeSeconds = watch.lap();

    const LevelSetSummary summary = summarize(result);
    const Json json = {{"output", a.output},
                       {"voxel_size", voxelJson(summary.voxelSize)},
                       {"active_voxels", summary.activeVoxels},
                       {"band", summary.background},
                       {"seconds", {{"read", readSeconds}, {"build", buildSeconds}, {"write", writeSeconds}}}};
    report(common, json,
           a.output + ": voxel " + voxelText(summary.voxelSize) + ", " + grouped(summary.activeVoxels) +
               " active voxels, band " + rounded(summary.background) + ", " + rounded(buildSeconds) + " s");
}

} // namespace

void addRedistance(CLI::App& app, const CommonOptions& common)
{
    auto* verb = app.add_subcommand("redistance", "Make a grid of any values signed distances to its surface");
    auto a = std::make_shared<RedistanceArguments>();
    verb->add_option("IN", a->input, "Level set, fog volume or other grid of numbers, .vdb")->required();
    verb->add_option("-o,--output", a->output, "Level set to write, .vdb")->required();
    verb->add_option("--grid", a->grid, "Grid to read (default: the first level set, or else the first of numbers)");
    verb->add_option("--iso", a->iso, "Value at the surface (default 0; of a fog volume 0.5)")->type_name("V");
    addChoice(*verb, "--inside", a->inside, kSides,
              "Where values are below or above that one (default below; of a fog volume above)");
    addBandOptions(*verb, a->band, "default that of a level set, else 3vx; vx are multiples of a voxel's longest side");
    addBytes(*verb, "--max-memory", a->options.maxMemory,
             "Refuse what would need more (default three quarters of the machine's)");
    verb->add_option("--name", a->options.name, "Name of the grid (default: as it was)");
    verb->add_flag("--half", a->half, "Store values as 16-bit floats");
    verb->footer("Example:\n  vdbounce redistance smoke.vdb -o smoke_surface.vdb --iso 0.2 --band 5vx");
    verb->callback([a, &common] { runWith(common, [&] { runRedistance(*a, common); }); });
}

} // namespace vdbounce::tool
