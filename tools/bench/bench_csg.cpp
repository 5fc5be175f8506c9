// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_csg.h"

#include "bench/stopwatch.h"
#include "bench/thread_counts.h"

#include "vdbounce/base/error.h"
#include "vdbounce/implicit/grid_csg.h"
#include "vdbounce/io/openvdb_grid.h"

#include <openvdb/tools/Composite.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <functional>

namespace vdbounce::bench {
namespace {

using openvdb::FloatGrid;
constexpr float kBandVx = 3.0f;

struct Setting {
    std::string name;
    float radius;  // voxels
    float between; // centres, voxels
};

const Setting kSettings[] = {{"spheres of radius 100", 100.0f, 100.0f},
                             {"spheres of radius 200", 200.0f, 200.0f},
                             {"spheres of radius 400", 400.0f, 400.0f},
                             {"distant spheres of radius 200", 200.0f, 3000.0f}};

struct Operation {
    CsgOperation ours;
    std::string name;
    std::string peer;
    std::function<FloatGrid::Ptr(const FloatGrid&, const FloatGrid&)> theirs;
};

FloatGrid::Ptr unionOfCopies(const FloatGrid& a, const FloatGrid& b)
{
    const FloatGrid::Ptr result = a.deepCopy();
    const FloatGrid::Ptr consumed = b.deepCopy();
    openvdb::tools::csgUnion(*result, *consumed);
    return result;
}

const Operation kOperations[] = {
    {CsgOperation::Union, "union", "csgUnionCopy", [](auto& a, auto& b) { return openvdb::tools::csgUnionCopy(a, b); }},
    {CsgOperation::Union, "union", "csgUnion of copies", unionOfCopies},
    {CsgOperation::Intersection, "intersection", "csgIntersectionCopy",
     [](auto& a, auto& b) { return openvdb::tools::csgIntersectionCopy(a, b); }},
    {CsgOperation::Subtraction, "subtraction", "csgDifferenceCopy",
     [](auto& a, auto& b) { return openvdb::tools::csgDifferenceCopy(a, b); }}};

LevelSetGrid ball(float radius, float x)
{
    return toLevelSetGrid(
        openvdb::tools::createLevelSetSphere<FloatGrid>(radius, openvdb::Vec3f(x, 0.0f, 0.0f), 1.0f, kBandVx), "ball");
}

// Looks at every voxel and tile that either has for itself.
void requireSame(const FloatGrid& ours, const FloatGrid& theirs, const std::string& name)
{
    const FloatGrid* const grids[] = {&ours, &theirs};
    for (int g = 0; g < 2; ++g) {
        auto other = grids[1 - g]->getConstAccessor();
        for (auto value = grids[g]->cbeginValueAll(); value; ++value) {
            if (other.getValue(value.getCoord()) == *value) continue;
            throw RunError("bench csg", name + " differs from OpenVDB's in a voxel", "please report it");
        }
    }
}

Case measure(const Operation& operation, const LevelSetGrid& a, const LevelSetGrid& b, int repetitions,
             Progress& progress)
{
    std::vector<double> oursSeconds;
    std::vector<double> theirSeconds;
    for (int r = 0; r < repetitions; ++r) {
        throwIfStopped(progress);
        GridCsg ours;
        FloatGrid::Ptr theirs;
        const auto runOurs = [&] { oursSeconds.push_back(seconds([&] { ours = csg(operation.ours, a, b); })); };
        // By turns the first, who finds the memory of the last round in pieces.
        if (r % 2 == 0) runOurs();
        theirSeconds.push_back(seconds([&] { theirs = operation.theirs(toOpenVdb(a), toOpenVdb(b)); }));
        if (r % 2 == 1) runOurs();
        if (r == 0) requireSame(toOpenVdb(ours.grid), *theirs, operation.name);
    }
    Case one{operation.name, "ms", 1e3 * median(oursSeconds), std::nullopt};
    one.peer = Peer{operation.peer, 1e3 * median(theirSeconds)};
    return one;
}

} // namespace

Cases benchCsg(const MakeBenchOptions& options, Progress& progress)
{
    openvdb::initialize();
    Cases cases;
    for (const Setting& setting : kSettings) {
        const LevelSetGrid a = ball(setting.radius, 0.0f);
        const LevelSetGrid b = ball(setting.radius, setting.between);
        onOneAndAllThreads([&](const std::string& threads) {
            for (const Operation& operation : kOperations) {
                Case one = measure(operation, a, b, options.repetitions, progress);
                one.name = one.name + " of " + setting.name + ", " + threads;
                cases.push_back(std::move(one));
            }
        });
    }
    return cases;
}

} // namespace vdbounce::bench
