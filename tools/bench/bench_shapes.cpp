// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_shapes.h"

#include "bench/stopwatch.h"
#include "bench/thread_counts.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/implicit/sample_field.h"
#include "vdbounce/implicit/shapes.h"
#include "vdbounce/io/openvdb_grid.h"
#include "vdbounce/io/vdb_archive.h"

#include <openvdb/tools/LevelSetPlatonic.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace vdbounce::bench {
namespace {

constexpr float kBandVx = 3.0f;

// Off the voxel centres, as scenes are; voxels have side 1.
const Vec3d kCentre(0.3, 0.2, 0.1);

struct ShapeCase {
    std::string name;
    ShapeFormula formula;
    std::string peer;
    std::function<openvdb::FloatGrid::Ptr()> theirs;
};

openvdb::Vec3f toOpenVdb(const Vec3d& v) { return {float(v.x()), float(v.y()), float(v.z())}; }

ShapeCase sphereCase(double radius)
{
    return {"sphere of radius " + std::to_string(int(radius)), SphereShape{kCentre, radius}, "OpenVDB levelSetSphere",
            [=] {
                return openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(float(radius), toOpenVdb(kCentre), 1.0f,
                                                                                kBandVx);
            }};
}

ShapeCase cubeCase(double half)
{
    return {"cube of " + std::to_string(int(2.0 * half)), BoxShape{kCentre, Vec3d::Constant(half)},
            "OpenVDB levelSetCube", [=] {
                return openvdb::tools::createLevelSetCube<openvdb::FloatGrid>(float(2.0 * half), toOpenVdb(kCentre),
                                                                              1.0f, kBandVx);
            }};
}

// The farthest that an active voxel is off the shape's phi, voxels.
double largestError(const openvdb::FloatGrid& grid, const ImplicitField& field)
{
    std::vector<const openvdb::FloatTree::LeafNodeType*> leaves;
    grid.tree().getNodes(leaves);
    std::vector<double> errors(leaves.size(), 0.0);
    forEachIndex(leaves.size(), 64, [&](std::size_t i) {
        for (auto voxel = leaves[i]->cbeginValueOn(); voxel; ++voxel) {
            const openvdb::Coord at = voxel.getCoord();
            errors[i] = std::max(errors[i], std::abs(*voxel - field.phi(Vec3d(at.x(), at.y(), at.z()), 0.0)));
        }
    });
    return errors.empty() ? 0.0 : *std::max_element(errors.begin(), errors.end());
}

Cases measure(const ShapeCase& shape, const MakeBenchOptions& options, Progress& progress)
{
    const auto field = makeField(shape.formula);
    SampleFieldOptions sampling;
    sampling.voxelSize = 1.0;
    LevelSetGrid ours;
    openvdb::FloatGrid::Ptr theirs;
    std::vector<double> ourSeconds;
    std::vector<double> theirSeconds;
    for (int r = 0; r < options.repetitions; ++r) {
        throwIfStopped(progress);
        ours = LevelSetGrid();
        ourSeconds.push_back(seconds([&] { ours = sampleField(*field, sampling); }));
        theirs.reset();
        theirSeconds.push_back(seconds([&] { theirs = shape.theirs(); }));
    }
    const std::string name = shape.name + ", " + threadsText();
    return {{name, "s", median(ourSeconds), Peer{shape.peer, median(theirSeconds)}},
            {shape.name + ", largest error", "vx", largestError(vdbounce::toOpenVdb(ours), *field),
             Peer{shape.peer, largestError(*theirs, *field)}}};
}

} // namespace

Cases benchShapes(const MakeBenchOptions& options, Progress& progress)
{
    initializeOpenVdb();
    const ShapeCase shapes[] = {sphereCase(1000.0), sphereCase(100.0), cubeCase(100.0)};
    Cases cases;
    for (const ShapeCase& shape : shapes) {
        for (const Case& one : measure(shape, options, progress)) cases.push_back(one);
        progress.update(std::uint64_t(&shape - shapes) + 1, std::size(shapes));
    }
    return cases;
}

} // namespace vdbounce::bench
