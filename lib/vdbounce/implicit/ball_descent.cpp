// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/ball_descent.h"

#include "vdbounce/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace vdbounce {
namespace {

// Half of all leaves that OpenVDB's coordinates reach, and a cube around them.
constexpr int kLowestLeaf = -(1 << 28);
constexpr int kRootLevel = 29;

// Cubes of more leaves a side than 2^this are replaced by the smallest cube around their balls: below, looking for it
// costs more than it spares.
constexpr int kDenseLevel = 4;

// Parts with fewer balls than this are no tasks of their own.
constexpr std::size_t kBallsForTask = 2048;

// Balls that a task sorts into eighths.
constexpr std::size_t kBallsPerBlock = 16384;

// Units of progress, shared out by the number of balls.
constexpr std::uint64_t kWholeWork = std::uint64_t(1) << 40;

// Cubes of this level tell how far the work is.
constexpr int kToldLevel = 2;

using Eighths = std::array<BallList, 8>;
using Counts = std::array<std::uint32_t, 8>;

LeafCube childOf(const LeafCube& cube, std::size_t which)
{
    const int half = cube.side() / 2;
    return {cube.leaf + half * Vec3i(int(which >> 2), int(which >> 1 & 1), int(which & 1)), cube.level - 1};
}

BoxHalves halvesOf(const LeafCube& cube)
{
    const Box low = childOf(cube, 0).voxels();
    const Box high = childOf(cube, 7).voxels();
    BoxHalves halves{};
    for (int axis = 0; axis < 3; ++axis) {
        halves.min[axis][0] = low.min[axis];
        halves.max[axis][0] = low.max[axis];
        halves.min[axis][1] = high.min[axis];
        halves.max[axis][1] = high.max[axis];
    }
    return halves;
}

// Around what its balls reach, for combining in blocks.
struct ReachBox {
    Box box;
    ReachBox& operator+=(const ReachBox& other)
    {
        box.add(other.box);
        return *this;
    }
};

class Descent {
public:
    Descent(const BallReach& reach, BallWork& work, Progress& progress)
        : reach_(reach), work_(work), counter_(progress, kWholeWork)
    {
    }

    void run(BallList balls) { search({Vec3i::Constant(kLowestLeaf), kRootLevel}, std::move(balls), kWholeWork); }

private:
    void search(LeafCube cube, BallList list, std::uint64_t share)
    {
        if (cube.level > kDenseLevel) cube = smallestAround(cube, list);
        if (!work_.settled(cube, list.begin(), list.size())) {
            if (cube.level == 0) {
                work_.leaf(cube.leaf, list.begin(), list.size());
            } else {
                searchParts(cube, list, cube.level > kToldLevel ? share : 0);
                if (cube.level > kToldLevel) return;
            }
        }
        if (share > 0) counter_.add(share);
    }

    void searchParts(const LeafCube& cube, BallList& list, std::uint64_t share)
    {
        Eighths parts;
        split(cube, list, parts);
        const bool large = list.size() >= kBallsForTask;
        list.clear();
        std::size_t total = 0;
        for (const BallList& part : parts) total += part.size();
        const auto searchPart = [&](std::size_t which) {
            if (parts[which].empty()) return;
            const double part = double(parts[which].size()) / double(total);
            search(childOf(cube, which), std::move(parts[which]), std::uint64_t(double(share) * part));
        };
        if (large) {
            forEachIndex(8, 1, searchPart);
        } else {
            for (std::size_t which = 0; which < 8; ++which) searchPart(which);
        }
    }

    // Of the cubes that can come of halving this one, the smallest with all that its balls reach of it.
    LeafCube smallestAround(const LeafCube& cube, const BallList& list) const
    {
        const Box whole = cube.voxels();
        const Box box = reduceBlocks(list.size(), kBallsPerBlock, ReachBox{}, [&](IndexRange range) {
                            ReachBox part;
                            for (std::size_t i = range.begin; i < range.end; ++i) {
                                const Ball& ball = list[i];
                                const Vec3d centre(ball.x, ball.y, ball.z);
                                const Vec3d reach = Vec3d::Constant(reach_.of(ball) + 1.0);
                                part.box.add((centre - reach).cwiseMax(whole.min));
                                part.box.add((centre + reach).cwiseMin(whole.max));
                            }
                            return part;
                        }).box;
        const Vec3i low = (box.min / LeafCube::kLeafSide).array().floor().cast<int>() - kLowestLeaf;
        const Vec3i high = (box.max / LeafCube::kLeafSide).array().floor().cast<int>() - kLowestLeaf;
        LeafCube smallest{low, 0};
        for (int axis = 0; axis < 3; ++axis) {
            while (smallest.level < cube.level && low[axis] >> smallest.level != high[axis] >> smallest.level)
                ++smallest.level;
        }
        for (int axis = 0; axis < 3; ++axis)
            smallest.leaf[axis] = (low[axis] >> smallest.level << smallest.level) + kLowestLeaf;
        return smallest;
    }

    // Each eighth's balls, in order.
    void split(const LeafCube& cube, const BallList& list, Eighths& parts) const
    {
        const BoxHalves halves = halvesOf(cube);
        const std::size_t blocks = blockCount(list.size(), kBallsPerBlock);
        std::vector<std::uint8_t> reached(list.size());
        std::vector<Counts> places(blocks); // how many a block has, then where it begins
        forEachBlock(list.size(), kBallsPerBlock, [&](std::size_t block, IndexRange range) {
            findReachedEighths(list.begin() + range.begin, range.end - range.begin, reach_, halves,
                               reached.data() + range.begin);
            Counts counts{};
            for (std::size_t i = range.begin; i < range.end; ++i) {
                for (std::size_t which = 0; which < 8; ++which) counts[which] += reached[i] >> which & 1u;
            }
            places[block] = counts;
        });
        Counts sum{};
        for (Counts& place : places) {
            for (std::size_t which = 0; which < 8; ++which) sum[which] += std::exchange(place[which], sum[which]);
        }
        for (std::size_t which = 0; which < 8; ++which) {
            if (sum[which] > 0) parts[which] = BallList(sum[which]);
        }
        forEachBlock(list.size(), kBallsPerBlock, [&](std::size_t block, IndexRange range) {
            std::array<Ball*, 8> to;
            for (std::size_t which = 0; which < 8; ++which) to[which] = parts[which].data() + places[block][which];
            for (std::size_t i = range.begin; i < range.end; ++i) {
                for (unsigned bits = reached[i]; bits != 0; bits &= bits - 1)
                    *to[std::size_t(__builtin_ctz(bits))]++ = list[i];
            }
        });
    }

    const BallReach reach_;
    BallWork& work_;
    ProgressCounter counter_;
};

} // namespace

void visitLeaves(BallList balls, const BallReach& reach, BallWork& work, Progress& progress)
{
    throwIfStopped(progress);
    if (balls.empty()) return;
    Descent(reach, work, progress).run(std::move(balls));
}

} // namespace vdbounce
