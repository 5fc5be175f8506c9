// SPDX-License-Identifier: Apache-2.0
#include "make_arguments.h"
#include "make_output.h"
#include "progress_bar.h"
#include "signals.h"
#include "stopwatch.h"

#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/implicit/heightfield_mesh.h"

#include <memory>

namespace vdbounce::tool {
namespace {

struct HeightfieldArguments {
    std::string map;
    HeightfieldOptions options;
    MakeArguments make;
};

MeshToLevelSetOptions conversionOptions(const MakeArguments& make)
{
    MeshToLevelSetOptions options;
    options.voxelSize = make.voxel;
    options.exteriorVx = make.exteriorVx();
    options.interiorVx = make.interiorVx();
    options.sign = SignMethod::Winding;
    options.gridName = make.name;
    options.maxMemory = make.maxMemory;
    return options;
}

void run(const HeightfieldArguments& arguments, const CommonOptions& common)
{
    requireSound(arguments.make);
    endAtOnceWhenInterrupted();
    const HeightMap map = readHeightMap(arguments.map);
    Stopwatch building;
    const LevelSetGrid grid = [&] {
        ProgressBar progress(common, "make heightfield");
        return meshToLevelSet(heightfieldMesh(map, arguments.options), conversionOptions(arguments.make), progress)
            .grid;
    }();
    writeMade(grid, "heightfield", arguments.make, building.lap(), common);
}

} // namespace

void addMakeHeightfield(CLI::App& make, const CommonOptions& common)
{
    auto* verb = make.add_subcommand("heightfield", "The solid under a map of heights");
    auto arguments = std::make_shared<HeightfieldArguments>();
    verb->add_option("FILE", arguments->map, "Heights: a gray .png, or rows of numbers in a .csv or .txt")->required();
    addVector(*verb, "--min", arguments->options.min,
              "Where the map's first corner lies, x and z; y is the height of black, or of 0")
        ->required();
    addVector(*verb, "--max", arguments->options.max, "Where its last corner lies; y is the height of white, or of 1")
        ->required();
    verb->add_option("--base", arguments->options.base,
                     "Height of the flat bottom (default a tenth of the longer side below the lowest)")
        ->type_name("Y");
    addMakeOptions(*verb, arguments->make);
    verb->footer(
        "Example:\n  vdbounce make heightfield hills.png --min -10,0,-10 --max 10,3,10 --voxel 0.05 -o hills.vdb");
    verb->callback([arguments, &common] { runWith(common, [&] { run(*arguments, common); }); });
}

} // namespace vdbounce::tool
