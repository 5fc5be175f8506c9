// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/redistance.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/voxel_limits.h"
#include "vdbounce/field/band_width.h"
#include "vdbounce/field/openvdb_transform.h"
#include "vdbounce/implicit/distance_assembly.h"
#include "vdbounce/implicit/foot_points.h"
#include "vdbounce/implicit/leaf_limit.h"
#include "vdbounce/io/number_text.h"
#include "vdbounce/io/vdb_archive.h"

#include <openvdb/tools/Statistics.h>

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

constexpr double kDefaultBandVx = 3.0;

// While closest points are sought, and the result.
constexpr double kBytesPerWorkedLeaf = sizeof(FootLeaf) + kBytesPerLeaf;

double bandVx(const char* name, const std::optional<Length>& given, const openvdb::FloatGrid& grid, double unit)
{
    if (!given) {
        const double own = grid.background() / unit;
        const bool usable =
            grid.getGridClass() == openvdb::GRID_LEVEL_SET && own >= kNarrowestBandVx && own < kWidestBandVx;
        return usable ? own : kDefaultBandVx;
    }
    const double voxels = given->voxels(unit);
    if (!(voxels >= kNarrowestBandVx && voxels < kWidestBandVx))
        throw UsageError(name, numberText(voxels) + " voxels is out of range",
                         "give at least one voxel, for example 3vx");
    return voxels;
}

[[noreturn]] void throwWithoutSurface(const openvdb::FloatGrid& grid, const std::string& place, double iso)
{
    if (grid.activeVoxelCount() == 0)
        throw InputError(place, "has no active voxels, so no surface", "give a grid with values around a surface");
    const auto range = openvdb::tools::minMax(grid.tree());
    throw InputError(place,
                     "never takes the value " + numberText(iso) + " between its voxels: its values are from " +
                         numberText(range.min()) + " to " + numberText(range.max()),
                     "give an iso value that it does take");
}

} // namespace

LevelSetGrid redistance(const ScalarGrid& implicit, const RedistanceOptions& options, Progress& progress)
{
    initializeOpenVdb();
    const openvdb::FloatGrid& grid = toOpenVdb(implicit);
    const std::string place = "grid '" + grid.getName() + "'";
    if (!std::isfinite(options.iso))
        throw UsageError("iso", numberText(options.iso) + " is no number", "give a value that the grid takes");
    if (!grid.transform().isLinear()) throw InputError(place, "has a transform that is not linear", "resample it");
    const VoxelMetric metric(toLinearTransform(grid.transform()));
    const double exterior = bandVx("exterior band", options.exterior, grid, metric.unit);
    const double interior = bandVx("interior band", options.interior, grid, metric.unit);

    const ImplicitSamples samples(grid, options.iso, options.inside);
    constexpr std::uint64_t kStages = 3; // surface, closest points, grid
    samples.requireFinite();
    const FittedSurface surface = fitSurface(samples, metric, progress);
    if (surface.patches.empty()) throwWithoutSurface(grid, place, options.iso);
    progress.update(1, kStages);
    FootLeaves feet = findFeet(surface, metric, float(std::max(exterior, interior)),
                               leavesWithin(options.maxMemory, kBytesPerWorkedLeaf), progress);
    progress.update(2, kStages);
    const DistanceBand band{bandWidth(exterior * metric.unit), bandWidth(interior * metric.unit)};
    LevelSetGrid result = assembleDistances(std::move(feet), surface, samples, metric, band,
                                            options.name.empty() ? grid.getName() : options.name);
    progress.update(kStages, kStages);
    return result;
}

} // namespace vdbounce
