// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/left_out_voxels.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/base/quantile.h"
#include "vdbounce/base/random_numbers.h"
#include "vdbounce/field/leaf_sample.h"
#include "vdbounce/io/openvdb_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vdbounce {
namespace {

constexpr std::size_t kLeaves = 4096; // a tenth of a second
constexpr std::size_t kLeavesPerTask = 32;

// Of fewer voxels no quantile tells; and of three axes so many must have distances on both sides: on flat ground the
// two along it do, in bands thinner than two voxels hardly any.
constexpr std::size_t kFewestVoxels = 200;
constexpr double kKnownShare = 0.55;

// What splines were off by at spheres of 16 to 64 voxels, where leaving voxels out tells less.
constexpr double kLeastVx = 2e-4;

// How far voxels are from what others make of them.
struct Misses {
    std::vector<double> linear2, linear4; // those on both sides, two and four voxels apart
    std::vector<double> spline2;          // four of them, two apart
    std::size_t known = 0;                // axes along which there are four

    Misses& operator+=(const Misses& more)
    {
        linear2.insert(linear2.end(), more.linear2.begin(), more.linear2.end());
        linear4.insert(linear4.end(), more.linear4.begin(), more.linear4.end());
        spline2.insert(spline2.end(), more.spline2.begin(), more.spline2.end());
        known += more.known;
        return *this;
    }

    bool tell() const
    {
        return spline2.size() >= kFewestVoxels && double(known) >= kKnownShare * 3.0 * double(spline2.size());
    }
};

class LeavingOut {
public:
    explicit LeavingOut(const openvdb::FloatGrid& grid)
        : values_(grid.getConstAccessor()), band_(grid.background()),
          voxel_(std::min({grid.voxelSize().x(), grid.voxelSize().y(), grid.voxelSize().z()}))
    {
    }

    // Halfway between voxels they are the farthest off, by 4 t (1 - t) of that elsewhere: `at` is any place in a cell.
    void add(const openvdb::Coord& voxel, const Vec3d& at, Misses& misses)
    {
        const double middle = values_.getValue(voxel);
        if (!(std::abs(middle) < voxel_)) return;
        double linear2 = 0.0;
        double linear4 = 0.0;
        double spline2 = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            const Pair two = pair(voxel, axis, 1);
            const Pair four = pair(voxel, axis, 2);
            const Pair six = pair(voxel, axis, 3);
            const double share = 4.0 * at[axis] * (1.0 - at[axis]);
            if (four.known) {
                linear2 += share * (0.5 * two.sum - middle);
                linear4 += share * (0.5 * four.sum - middle);
            }
            misses.known += six.known ? 1 : 0;
            if (six.known) spline2 += share * ((9.0 * two.sum - six.sum) / 16.0 - middle); // Catmull-Rom, halfway
        }
        misses.linear2.push_back(std::abs(linear2));
        misses.linear4.push_back(std::abs(linear4));
        misses.spline2.push_back(std::abs(spline2));
    }

private:
    struct Pair {
        double sum;
        bool known; // at the end of the band values are no distances
    };

    Pair pair(const openvdb::Coord& voxel, int axis, int steps)
    {
        openvdb::Coord below = voxel;
        openvdb::Coord above = voxel;
        below[axis] -= steps;
        above[axis] += steps;
        const double a = values_.getValue(below);
        const double b = values_.getValue(above);
        return {a + b,
                values_.isValueOn(below) && values_.isValueOn(above) && std::max(std::abs(a), std::abs(b)) < band_};
    }

    openvdb::FloatGrid::ConstAccessor values_;
    double band_;
    double voxel_;
};

} // namespace

Resolution estimateResolution(const LevelSetGrid& grid, std::uint64_t seed)
{
    constexpr int kSide = int(openvdb::FloatTree::LeafNodeType::DIM);
    constexpr int kVoxels = kSide * kSide * kSide;
    const std::vector<Vec3i> leaves = sampleLeaves(grid, kLeaves, seed);
    const Misses misses = reduceBlocks(leaves.size(), kLeavesPerTask, Misses(), [&](IndexRange range) {
        Misses found;
        LeavingOut leavingOut(toOpenVdb(grid));
        for (std::size_t l = range.begin; l < range.end; ++l) {
            for (int i = 0; i < kVoxels; ++i) {
                const Vec3i voxel = leaves[l] + Vec3i(i / (kSide * kSide), i / kSide % kSide, i % kSide);
                const std::uint64_t number = l * kVoxels + std::uint64_t(i);
                leavingOut.add({voxel.x(), voxel.y(), voxel.z()}, CounterRandom(seed, number).uniformVector(), found);
            }
        }
        return found;
    });
    Resolution resolution;
    if (misses.spline2.empty()) return resolution;
    const double linear2 = quantile(misses.linear2, kErrorShare);
    const double linear4 = quantile(misses.linear4, kErrorShare);
    if (linear2 > 0.0) resolution.order = std::clamp(std::log2(linear4 / linear2), 1.0, 2.0);
    resolution.error = quantile(misses.spline2, kErrorShare) / std::pow(2.0, resolution.order) +
                       kLeastVx * toOpenVdb(grid).voxelSize().x();
    if (!misses.tell()) resolution.error = std::numeric_limits<double>::infinity();
    return resolution;
}

} // namespace vdbounce
