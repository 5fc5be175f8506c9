// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_mesh.h"

#include "bench/memory_peak.h"
#include "bench/mesh_peers.h"
#include "bench/stopwatch.h"
#include "bench/thread_counts.h"

#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/build/verify_level_set.h"

#include <cstdio>
#include <functional>
#include <vector>

namespace vdbounce::bench {
namespace {

constexpr std::uint64_t kCheckedVoxels = 20'000; // a second or two on the largest mesh

// Carries Ctrl-C to the work that is measured, and nothing back: how far a single grid is would make the bar jump.
class StopOnly : public Progress {
public:
    explicit StopOnly(const Progress& progress) : progress_(progress) {}
    bool stopRequested() const override { return progress_.stopRequested(); }

private:
    const Progress& progress_;
};

// Measures one way to make the grid, again and again.
class Making {
public:
    explicit Making(std::function<LevelSetGrid()> make) : make_(std::move(make)) {}

    void run()
    {
        grid_ = LevelSetGrid(); // or the one before would be freed on the clock
        const MemoryPeak peak;
        const double processorBefore = processorSeconds();
        wallSeconds_.push_back(seconds([&] { grid_ = make_(); }));
        cpuSeconds_.push_back(processorSeconds() - processorBefore);
        if (const auto bytes = peak.bytes()) peakBytes_.push_back(*bytes);
    }

    // `sheets`: the thickness of those that open parts became, world; none did where it is zero.
    MeshFigures figures(const TriangleMesh& mesh, double sheets) const
    {
        MeshFigures figures;
        figures.cpuSeconds = median(cpuSeconds_);
        figures.wallSeconds = median(wallSeconds_);
        if (!peakBytes_.empty()) figures.peakBytes = median(peakBytes_);
        const LevelSetSummary summary = summarize(grid_);
        figures.gridBytes = double(summary.memoryBytes);
        figures.activeVoxels = summary.activeVoxels;
        VerifyOptions verify;
        verify.samples = kCheckedVoxels;
        // Only distances are looked at, but those to sheets are to their surfaces.
        verify.sign = sheets > 0.0 ? SignMethod::Auto : SignMethod::Winding;
        verify.thickness = sheets;
        figures.largestErrorVx = verifyLevelSet(grid_, mesh, verify).maxErrorVx;
        return figures;
    }

private:
    std::function<LevelSetGrid()> make_;
    LevelSetGrid grid_;
    std::vector<double> cpuSeconds_;
    std::vector<double> wallSeconds_;
    std::vector<double> peakBytes_;
};

double bytesOf(const TriangleMesh& mesh)
{
    return double(mesh.points.size() * sizeof(Vec3d) + mesh.triangles.size() * sizeof(TriangleMesh::Triangle));
}

std::string nameOf(const MeshBenchResult& result)
{
    char band[32];
    std::snprintf(band, sizeof(band), "%g", result.options.bandVx);
    return result.mesh + " at " + std::to_string(result.options.dim) + ", band " + band + ", " + result.threads;
}

} // namespace

MeshBenchResult benchMesh(const std::string& name, const TriangleMesh& mesh, const MeshBenchOptions& options,
                          Progress& progress)
{
    MeshToLevelSetOptions make;
    make.voxelSize = boundingBox(mesh).size().maxCoeff() / options.dim;
    make.exteriorVx = options.bandVx;
    make.interiorVx = options.bandVx;
    StopOnly stop(progress);
    Making ours([&] { return meshToLevelSet(mesh, make, stop).grid; });
    Making theirs([&] { return meshToVolume(mesh, make, stop); });
    std::uint64_t made = 0;
    for (int r = 0; r < options.repetitions; ++r) {
        for (Making* making : {&ours, &theirs}) {
            throwIfStopped(progress);
            making->run();
            progress.update(++made, 2 * std::uint64_t(options.repetitions));
        }
    }
    MeshBenchResult result;
    result.mesh = name;
    result.threads = threadsText();
    result.options = options;
    result.name = nameOf(result);
    result.triangles = mesh.triangles.size();
    result.meshBytes = bytesOf(mesh);
    result.ours = ours.figures(mesh, make.thicknessVx * make.voxelSize);
    throwIfStopped(progress);
    result.theirs = theirs.figures(mesh, 0.0);
    return result;
}

Cases casesOf(const MeshBenchResult& result)
{
    Cases cases;
    const MeshFigures& ours = result.ours;
    const MeshFigures& theirs = result.theirs;
    const auto add = [&](const char* what, const char* unit, double value, std::optional<double> peer) {
        Case one{result.name + ", " + what, unit, value, std::nullopt};
        if (peer) one.peer = Peer{kMeshToVolume, *peer};
        cases.push_back(one);
    };
    add("triangles", "triangles", double(result.triangles), std::nullopt);
    add("processor time", "s", ours.cpuSeconds, theirs.cpuSeconds);
    add("wall time", "s", ours.wallSeconds, theirs.wallSeconds);
    add("largest error", "vx", ours.largestErrorVx, theirs.largestErrorVx);
    add("active voxels", "voxels", double(ours.activeVoxels), double(theirs.activeVoxels));
    if (ours.peakBytes && theirs.peakBytes)
        add("peak memory", "MB", *ours.peakBytes / kMegabyte, *theirs.peakBytes / kMegabyte);
    add("finished grid", "MB", ours.gridBytes / kMegabyte, theirs.gridBytes / kMegabyte);
    add("mesh", "MB", result.meshBytes / kMegabyte, std::nullopt);
    return cases;
}

} // namespace vdbounce::bench
