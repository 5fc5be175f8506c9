// SPDX-License-Identifier: Apache-2.0
#include "make_output.h"

#include "report.h"
#include "stopwatch.h"

#include "vdbounce/io/grid_file.h"

namespace vdbounce::tool {

void writeMade(const LevelSetGrid& grid, const std::string& shape, const MakeArguments& arguments, double buildSeconds,
               const CommonOptions& common)
{
    Stopwatch writing;
    writeLevelSet(grid, arguments.output, {arguments.half, {}});
    const LevelSetSummary summary = summarize(grid);
    report(common,
           {{"output", arguments.output},
            {"shape", shape},
            {"voxel_size", arguments.voxel},
            {"active_voxels", summary.activeVoxels},
            {"exterior_vx", arguments.exteriorVx()},
            {"interior_vx", arguments.interiorVx()},
            {"seconds", {{"build", buildSeconds}, {"write", writing.lap()}}}},
           arguments.output + ": " + shape + " of " + grouped(summary.activeVoxels) + " voxels of " +
               rounded(arguments.voxel) + " in " + rounded(buildSeconds) + " s");
}

} // namespace vdbounce::tool
