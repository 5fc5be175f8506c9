// SPDX-License-Identifier: Apache-2.0
#include "bench/point_sets.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/parallel.h"
#include "vdbounce/base/random_numbers.h"

#include <algorithm>
#include <cmath>

namespace vdbounce::bench {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr std::size_t kPointsPerTask = 8192;
constexpr int kMostTries = 10000; // a point near a surface or beside a body needs two or three

// The voxels whose cells a point within `distance` of the surface can lie in.
std::vector<Vec3i> voxelsNearSurface(const DistanceField& field, double distance)
{
    const double reach = distance + field.transform().voxelDiagonal();
    std::vector<Vec3i> voxels;
    for (const Vec3i& origin : field.blocks().origins()) {
        for (int i = 0; i < BlockLayout::kLeafSide * BlockLayout::kLeafSide * BlockLayout::kLeafSide; ++i) {
            const Vec3i voxel = origin + Vec3i(i >> 6, i >> 3 & 7, i & 7);
            if (std::abs(field.blocks().valueAt(voxel)) < reach) voxels.push_back(voxel);
        }
    }
    return voxels;
}

[[noreturn]] void refuse(const char* needed)
{
    throw InputError("bench", std::string("the level set has no ") + needed, "measure another one");
}

} // namespace

std::vector<Vec3d> pointsNearSurface(const DistanceField& field, std::size_t count, const Interval& phiVx,
                                     std::uint64_t seed)
{
    const Interval phi{phiVx.lower * field.voxelSize(), phiVx.upper * field.voxelSize()};
    const std::vector<Vec3i> voxels = voxelsNearSurface(field, std::max(-phi.lower, phi.upper));
    const char* needed = "surface to put points near";
    if (voxels.empty()) refuse(needed);
    std::vector<Vec3d> points(count);
    forEachIndex(count, kPointsPerTask, [&](std::size_t i) {
        CounterRandom random(seed, i);
        int tries = 0;
        do {
            if (++tries > kMostTries) refuse(needed);
            const Vec3i& voxel = voxels[std::size_t(random.uniform() * double(voxels.size()))];
            points[i] = field.transform().toWorld(voxel.cast<double>() + random.uniformVector());
        } while (!phi.contains(field.phi(points[i])));
    });
    return points;
}

std::vector<Vec3d> pointsInBox(const DistanceField& field, std::size_t count)
{
    const Box& box = field.indexBox();
    std::vector<Vec3d> points(count);
    forEachIndex(count, kPointsPerTask, [&](std::size_t i) {
        CounterRandom random(kSeed, i);
        points[i] = field.transform().toWorld(box.min + random.uniformVector().cwiseProduct(box.size()));
    });
    return points;
}

std::vector<Vec3d> pointsOutside(const DistanceField& field, const Box& box, double distance, std::size_t count)
{
    std::vector<Vec3d> points(count);
    forEachIndex(count, kPointsPerTask, [&](std::size_t i) {
        CounterRandom random(kSeed, i);
        int tries = 0;
        do {
            if (++tries > kMostTries) refuse("room around it");
            points[i] = box.min + random.uniformVector().cwiseProduct(box.size());
        } while (!(field.phi(points[i]) > distance));
    });
    return points;
}

std::vector<Vec3d> inLeafOrder(const DistanceField& field, const std::vector<Vec3d>& points)
{
    // A counting sort; points in tiles come last.
    const LeafBlocks& blocks = field.blocks();
    const auto leafOf = [&](const Vec3d& point) {
        const Vec3d index = field.transform().toIndex(point).array().floor();
        const LeafBlocks::Entry entry = blocks.entryAt(index.cast<int>());
        return entry.isBlock() ? entry.block() : blocks.blockCount();
    };
    std::vector<std::size_t> next(blocks.blockCount() + 2);
    for (const Vec3d& point : points) ++next[leafOf(point) + 1];
    for (std::size_t i = 1; i < next.size(); ++i) next[i] += next[i - 1];
    std::vector<Vec3d> sorted(points.size());
    for (const Vec3d& point : points) sorted[next[leafOf(point)]++] = point;
    return sorted;
}

} // namespace vdbounce::bench
