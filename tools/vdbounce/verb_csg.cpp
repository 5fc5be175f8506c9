// SPDX-License-Identifier: Apache-2.0
#include "option_values.h"
#include "progress_bar.h"
#include "report.h"
#include "signals.h"
#include "stopwatch.h"

#include "vdbounce/implicit/grid_csg.h"
#include "vdbounce/io/grid_file.h"

#include <memory>

namespace vdbounce::tool {
namespace {

struct CsgArguments {
    std::string word;
    CsgOperation operation = CsgOperation::Union;
    std::vector<std::string> inputs;
    std::string output;
    std::optional<Length> blend;
    GridCsgOptions options;
    bool half = false;
};

const std::map<std::string, CsgOperation> kOperations = {{"union", CsgOperation::Union},
                                                         {"intersect", CsgOperation::Intersection},
                                                         {"subtract", CsgOperation::Subtraction},
                                                         {"complement", CsgOperation::Complement}};

const std::map<std::string, CsgVoxels> kVoxels = {{"finest", CsgVoxels::Finest}, {"first", CsgVoxels::First}};

void requireSound(const CsgArguments& a)
{
    const auto require = [](bool good, const char* what, const char* remedy) {
        if (!good) throw UsageError("vdbounce csg", what, remedy);
    };
    if (a.operation == CsgOperation::Complement) {
        require(a.inputs.size() == 1, "complement is of one level set", "use subtract to take one from another");
        require(!a.blend, "complement has no edges for --blend to round", "leave it out");
    } else {
        require(a.inputs.size() >= 2, "two level sets are needed, or more", "write csg union a.vdb b.vdb -o ab.vdb");
    }
    requireOutput(a.output, {"vdb"}, a.inputs);
}

// Takes the grids together from the left; only the result of all is redistanced.
GridCsg combineAll(const CsgArguments& arguments, const std::vector<LevelSetGrid>& grids, Progress& progress)
{
    if (arguments.operation == CsgOperation::Complement) return complement(grids[0], arguments.options, progress);
    GridCsg result{grids[0], {}};
    for (std::size_t i = 1; i < grids.size(); ++i) {
        GridCsgOptions options = arguments.options;
        options.blend = arguments.blend.value_or(Length{});
        options.redistance = options.redistance && i + 1 == grids.size();
        GridCsg next = csg(arguments.operation, result.grid, grids[i], options, progress);
        result.grid = next.grid;
        result.notes.insert(result.notes.end(), next.notes.begin(), next.notes.end());
    }
    return result;
}

void runCsg(const CsgArguments& arguments, const CommonOptions& common)
{
    requireSound(arguments);
    // All that is written is written at the end.
    endAtOnceWhenInterrupted();
    ProgressBar progress(common, "csg");
    Stopwatch watch;
    std::vector<LevelSetGrid> grids;
    for (const std::string& input : arguments.inputs) grids.push_back(readLevelSet(input));
    const double readSeconds = watch.lap();
    const GridCsg result = combineAll(arguments, grids, progress);
    const double buildSeconds = watch.lap();
    GridWriteOptions writing;
    writing.half = arguments.half;
    writeLevelSet(result.grid, arguments.output, writing);
    const LevelSetSummary summary = summarize(result.grid);
    for (const std::string& note : result.notes) announce(common, note);
    const Json json = {{"output", arguments.output},
                       {"operation", arguments.word},
                       {"operands", arguments.inputs},
                       {"voxel_size", toJson(summary.voxelSize)},
                       {"half_width_vx", summary.halfWidthVx},
                       {"active_voxels", summary.activeVoxels},
                       {"notes", result.notes},
                       {"seconds", {{"read", readSeconds}, {"build", buildSeconds}, {"write", watch.lap()}}}};
    report(common, json,
           arguments.output + ": " + grouped(summary.activeVoxels) + " active voxels, " +
               rounded(readSeconds + buildSeconds) + " s");
}

void addCsgOptions(CLI::App& verb, CsgArguments& a)
{
    const auto parse = [&a](const std::string& text) {
        const auto found = kOperations.find(text);
        if (found == kOperations.end())
            throw UsageError("csg", "'" + text + "' is no operation", "use union, intersect, subtract or complement");
        a.word = text;
        a.operation = found->second;
    };
    verb.add_option_function<std::string>("OP", parse, "union, intersect, subtract, complement")->required();
    verb.add_option("FILE", a.inputs, "Level sets, .vdb: two or more, taken together from the left; of complement one")
        ->required();
    verb.add_option("-o,--output", a.output, "Level set to write, .vdb")->required();
    addLength(verb, "--blend", a.blend, "Round the edges where surfaces meet, within this distance (default 0)");
    verb.add_flag("--redistance", a.options.redistance, "Make values distances again, which they are not beside edges");
    addChoice(verb, "--voxels", a.options.voxels, kVoxels,
              "Whose voxels the result has where they differ: finest, first (default finest)");
    verb.add_option("--name", a.options.name, "Name of the grid; else the first one's");
    verb.add_flag("--half", a.half, "Store values as 16-bit floats");
    verb.footer("Example:\n  vdbounce csg subtract block.vdb drill.vdb -o drilled.vdb --redistance");
}

} // namespace

void addCsg(CLI::App& app, const CommonOptions& common)
{
    auto* verb = app.add_subcommand("csg", "Unite, intersect or subtract level sets, or turn one inside out");
    auto arguments = std::make_shared<CsgArguments>();
    addCsgOptions(*verb, *arguments);
    verb->callback([arguments, &common] { runWith(common, [&] { runCsg(*arguments, common); }); });
}

} // namespace vdbounce::tool
