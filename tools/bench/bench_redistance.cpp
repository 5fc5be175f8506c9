// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_redistance.h"

#include "bench/redistance_shapes.h"
#include "bench/stopwatch.h"

#include "vdbounce/implicit/redistance.h"
#include "vdbounce/io/openvdb_grid.h"

#include <openvdb/tools/FastSweeping.h>
#include <openvdb/tools/LevelSetRebuild.h>

#include <array>
#include <cmath>
#include <functional>
#include <iterator>

namespace vdbounce::bench {
namespace {

constexpr float kBandVx = 3.0f;
constexpr int kVoxelsAUnit[] = {16, 32, 64, 128};
constexpr int kDistortedVoxelsAUnit = 64;
constexpr double kBesideEdgesVx = 4.0; // the band, and the cells that an edge bends

struct Errors {
    double largest = 0.0; // voxels
    double mean = 0.0;
    double largestAway = 0.0; // from edges
};

Errors errorsOf(const openvdb::FloatGrid& grid, const RedistanceShape& shape)
{
    const double voxel = grid.voxelSize()[0];
    Errors errors;
    double count = 0.0;
    for (auto it = grid.cbeginValueOn(); it; ++it) {
        const openvdb::Coord c = it.getCoord();
        const Vec3d p = voxel * Vec3d(c.x(), c.y(), c.z());
        const double error = std::abs(double(*it) - shape.phi(p)) / voxel;
        errors.largest = std::max(errors.largest, error);
        errors.mean += error;
        count += 1.0;
        if (shape.awayFromEdges(p, kBesideEdgesVx * voxel)) errors.largestAway = std::max(errors.largestAway, error);
    }
    errors.mean /= count;
    return errors;
}

// One way to redistance, measured again and again.
class Way {
public:
    Way(std::string name, std::function<openvdb::FloatGrid::ConstPtr(const ScalarGrid&)> make)
        : name_(std::move(name)), make_(std::move(make))
    {
    }
    void run(const ScalarGrid& grid)
    {
        result_.reset(); // or the one before would be freed on the clock
        seconds_.push_back(seconds([&] { result_ = make_(grid); }));
    }
    // Also begins anew.
    double takeSeconds()
    {
        const double result = median(seconds_);
        seconds_.clear();
        return result;
    }
    const std::string& name() const { return name_; }
    const openvdb::FloatGrid& result() const { return *result_; }

private:
    std::string name_;
    std::function<openvdb::FloatGrid::ConstPtr(const ScalarGrid&)> make_;
    std::vector<double> seconds_;
    openvdb::FloatGrid::ConstPtr result_;
};

using Ways = std::array<Way, 3>; // ours first

Ways ways()
{
    const auto ours = [](const ScalarGrid& grid) {
        RedistanceOptions options;
        options.exterior = options.interior = Length{double(kBandVx), true};
        return redistance(grid, options).holder().grid;
    };
    const auto sweeping = [](const ScalarGrid& grid) -> openvdb::FloatGrid::ConstPtr {
        return openvdb::tools::sdfToSdf(toOpenVdb(grid));
    };
    const auto rebuild = [](const ScalarGrid& grid) -> openvdb::FloatGrid::ConstPtr {
        return openvdb::tools::levelSetRebuild(toOpenVdb(grid), 0.0f, kBandVx);
    };
    return {Way("vdbounce", ours), Way("sdfToSdf", sweeping), Way("levelSetRebuild", rebuild)};
}

// A figure of ours beside that of each peer.
void addCases(Cases& cases, const std::string& name, const std::string& unit, const Ways& ways,
              const std::array<double, 3>& values)
{
    for (std::size_t peer = 1; peer < ways.size(); ++peer)
        cases.push_back({name, unit, values[0], Peer{ways[peer].name(), values[peer]}});
}

using MeanErrors = std::array<double, 3>; // world units

MeanErrors measure(const RedistanceShape& shape, const Distortion& distortion, int voxels, int repetitions,
                   Cases& cases)
{
    const ScalarGrid grid = distortedLevelSet(shape, distortion, 1.0 / voxels);
    Ways all = ways();
    for (int r = 0; r < repetitions; ++r) {
        for (Way& way : all) way.run(grid);
    }
    const std::string name = "redistance " + shape.name + ", " + distortion.name + ", " + std::to_string(voxels);
    std::array<double, 3> time{};
    std::array<double, 3> largest{};
    std::array<double, 3> mean{};
    std::array<double, 3> away{};
    MeanErrors world{};
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Errors errors = errorsOf(all[i].result(), shape);
        time[i] = all[i].takeSeconds();
        largest[i] = errors.largest;
        mean[i] = errors.mean;
        away[i] = errors.largestAway;
        world[i] = errors.mean / voxels;
    }
    addCases(cases, name, "s", all, time);
    addCases(cases, name + ", largest error", "vx", all, largest);
    addCases(cases, name + ", mean error", "vx", all, mean);
    if (away != largest) addCases(cases, name + ", largest error away from edges", "vx", all, away);
    return world;
}

} // namespace

Cases benchRedistance(const MakeBenchOptions& options, Progress& progress)
{
    Cases cases;
    const std::vector<Distortion> all = distortions();
    for (const RedistanceShape& shape : {unitSphere(), unitTorus(), slottedDisc()}) {
        std::vector<MeanErrors> errors;
        for (const int voxels : kVoxelsAUnit) {
            throwIfStopped(progress);
            errors.push_back(measure(shape, all.front(), voxels, options.repetitions, cases));
        }
        const double finer = double(*std::rbegin(kVoxelsAUnit)) / *std::begin(kVoxelsAUnit);
        for (std::size_t i = 0; i < errors.front().size(); ++i) {
            // Larger is better, so a ratio would mislead: a case for each.
            const double order = std::log2(errors.front()[i] / errors.back()[i]) / std::log2(finer);
            cases.push_back({"redistance " + shape.name + ", order of " + ways()[i].name(), "", order, {}});
        }
        for (std::size_t i = 1; i < all.size(); ++i) {
            throwIfStopped(progress);
            measure(shape, all[i], kDistortedVoxelsAUnit, options.repetitions, cases);
        }
    }
    return cases;
}

} // namespace vdbounce::bench
