// SPDX-License-Identifier: Apache-2.0
#include "bench/field_variants.h"

#include "bench/point_sets.h"
#include "bench/stopwatch.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/field/vector_lookup.h"
#include "vdbounce/io/grid_file.h"

#include <cmath>
#include <filesystem>

#include <tbb/global_control.h>
#include <unistd.h>

namespace vdbounce::bench {
namespace {

constexpr std::size_t kBoundsPoints = 100'000;
constexpr std::size_t kLeavesPerTask = 32;

// On one thread.
double timeOf(const DistanceField& field, const std::vector<Vec3d>& points, int repetitions,
              std::vector<PointSample>& samples)
{
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    return medianSeconds(repetitions, [&] { samplePoints(field, points.data(), points.size(), samples.data()); }) *
           1e9 / double(points.size());
}

double bytesPerLeaf(const DistanceField& field)
{
    return double(field.blocks().values().memoryBytes()) / double(field.blocks().blockCount());
}

// Seconds to read the grid from a file, which the system has in memory by then: the disk's own time is left out.
double secondsToRead(const LevelSetGrid& grid, int repetitions)
{
    const auto path = std::filesystem::temp_directory_path() / ("vdbounce-bench-" + std::to_string(getpid()) + ".vdb");
    writeLevelSet(grid, path);
    const double time = medianSeconds(repetitions, [&] { readLevelSet(path); });
    std::filesystem::remove(path);
    return time;
}

// What the tree adds to making the field, which has each block's values at hand: copying all blocks with and without
// looking for the surface in them.
double secondsToMakeTree(const DistanceField& field, int repetitions)
{
    const std::vector<Vec3i>& origins = field.blocks().origins();
    const auto pass = [&](bool withTree) {
        std::vector<SurfaceTree::Leaf> leaves(origins.size());
        forEachBlock(origins.size(), kLeavesPerTask, [&](std::size_t, IndexRange range) {
            float values[BlockLayout::kSize];
            for (std::size_t i = range.begin; i < range.end; ++i) {
                field.blocks().values().decode(i, values);
                leaves[i].origin = origins[i] + Vec3i::Constant(int(values[0] < 0.0f)); // so that it is not left out
                if (!withTree) continue;
                leaves[i] = SurfaceTree::leafOf(values, origins[i], field.indexBox(), field.transform(), 0.0);
            }
        });
        if (withTree) SurfaceTree(leaves, field.transform());
    };
    const int times = 5 * repetitions; // a difference of two small times
    const double with = medianSeconds(times, [&] { pass(true); });
    return with - medianSeconds(times, [&] { pass(false); });
}

// The same lookups on lesser processors, as far as this one can stand in for them. The results are the same.
void benchTargets(const FieldSubject& subject, const DistanceField& field, const std::vector<Vec3d>& points,
                  const FieldBenchOptions& options, Cases& cases)
{
    std::vector<PointSample> samples(points.size());
    for (const std::string& target : vectorTargets()) {
        chooseVectorTarget(target);
        const double time = timeOf(field, points, options.repetitions, samples);
        chooseVectorTarget("");
        cases.push_back({subject.name + ", vector code " + target + ", near the surface, random order, 1 thread",
                         "ns/point", time, std::nullopt});
    }
}

} // namespace

double largestDifference(const PointSample* a, const PointSample* b, std::size_t count, double voxelSize)
{
    double largest = 0.0;
    for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, std::abs(double(a[i].phi) - double(b[i].phi)));
    return largest / voxelSize;
}

void benchVariants(const FieldSubject& subject, const DistanceField& field, const std::vector<Vec3d>& points,
                   const FieldBenchOptions& options, Cases& cases)
{
    struct Variant {
        const char* name;
        FieldOptions options;
    };
    const Variant variants[] = {{"storage half", {Lookup::Trilinear, Normal::Central, Storage::Half}},
                                {"storage fixed8", {Lookup::Trilinear, Normal::Central, Storage::Fixed8}},
                                {"lookup nearest", {Lookup::Nearest, Normal::Central, Storage::Float}},
                                {"lookup cubic, normal analytic", {Lookup::Cubic, Normal::Analytic, Storage::Float}},
                                {"normal analytic", {Lookup::Trilinear, Normal::Analytic, Storage::Float}}};
    std::vector<PointSample> expected(points.size());
    std::vector<PointSample> samples(points.size());
    for (const Variant& variant : variants) {
        const DistanceField other(subject.grid, variant.options);
        const std::string name = subject.name + ", " + variant.name;
        const double ours = timeOf(other, points, options.repetitions, samples);
        cases.push_back({name + ", near the surface, random order, 1 thread", "ns/point", ours,
                         Peer{"the default", timeOf(field, points, options.repetitions, expected)}});
        if (variant.options.storage == Storage::Float) continue;
        cases.push_back(
            {name + ", memory", "bytes/leaf", bytesPerLeaf(other), Peer{"the default", bytesPerLeaf(field)}});
        const double error = largestDifference(samples.data(), expected.data(), points.size(), field.voxelSize());
        cases.push_back({name + ", largest error of phi", "vx", error,
                         Peer{"what it is bounded by", other.storageError() / field.voxelSize()}});
    }
    benchTargets(subject, field, points, options, cases);
}

void benchBounds(const FieldSubject& subject, const DistanceField& field, const FieldBenchOptions& options,
                 Cases& cases)
{
    const std::string name = subject.name + ", bounds";
    cases.push_back({name + ", making the tree", "s", secondsToMakeTree(field, options.repetitions),
                     Peer{"reading the grid from disk", secondsToRead(subject.grid, options.repetitions)}});
    cases.push_back({name + ", memory", "bytes", double(field.surface().memoryBytes()),
                     Peer{"the grid", double(summarize(subject.grid).memoryBytes)}});
    const std::vector<Vec3d> points = pointsInBox(field, kBoundsPoints);
    double widest = 0.0;
    const double time = seconds([&] {
        for (const Vec3d& point : points) {
            const Interval bounds = field.bounds(point);
            widest = std::max(widest, bounds.upper - bounds.lower);
        }
    });
    cases.push_back(
        {name + ", spread over the box, 1 thread", "ns/point", time * 1e9 / double(points.size()), std::nullopt});
    cases.push_back({name + ", widest from lower to upper in the box", "vx", widest / field.voxelSize(),
                     Peer{"half a leaf's diagonal", 4.0 * field.transform().voxelDiagonal() / field.voxelSize()}});
}

} // namespace vdbounce::bench
