// SPDX-License-Identifier: Apache-2.0
#include "make_arguments.h"

namespace vdbounce::tool {
namespace {

constexpr Length kUsualBand{3.0, true};

} // namespace

double MakeArguments::exteriorVx() const { return band.outside().value_or(kUsualBand).voxels(voxel); }

double MakeArguments::interiorVx() const { return band.inside().value_or(kUsualBand).voxels(voxel); }

void addMakeOptions(CLI::App& verb, MakeArguments& arguments)
{
    verb.add_option("-o,--output", arguments.output, "Level set to write, .vdb")->required();
    verb.add_option("--voxel", arguments.voxel, "Side of a voxel, world units")->required()->type_name("S");
    BandArguments& band = arguments.band;
    addLength(verb, "--band", band.band, "Half width of the narrow band on both sides (default 3vx)");
    addLength(verb, "--exterior", band.exterior, "Half width of the band outside");
    addLength(verb, "--interior", band.interior, "Half width of the band inside");
    verb.add_option("--name", arguments.name, "Name of the grid")->capture_default_str();
    // Not --half as elsewhere, which is half the sides of a box.
    verb.add_flag("--half-floats", arguments.half, "Store 16-bit floats: half the size, 11 bits of precision");
    addBytes(verb, "--max-memory", arguments.maxMemory,
             "Refuse what would need more (default three quarters of the machine's)");
}

void requireSound(const MakeArguments& arguments)
{
    if (arguments.band.clash()) throw UsageError("--band", "and --exterior or --interior are given", "give either");
    requireOutput(arguments.output, {"vdb"}, {});
}

} // namespace vdbounce::tool
