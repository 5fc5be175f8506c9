// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/value_range.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/io/openvdb_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vdbounce {
namespace {

constexpr std::size_t kLeavesPerTask = 64;

using Leaf = openvdb::FloatTree::LeafNodeType;

struct Range : ValueRange {
    Range()
    {
        lowest = std::numeric_limits<float>::infinity();
        highest = -std::numeric_limits<float>::infinity();
    }

    Range& operator+=(const Range& other)
    {
        if (notFinite == 0) firstNotFinite = other.firstNotFinite;
        notFinite += other.notFinite;
        values += other.values;
        lowest = std::min(lowest, other.lowest);
        highest = std::max(highest, other.highest);
        return *this;
    }

    void add(float value, const openvdb::Coord& voxel)
    {
        if (std::isfinite(value)) {
            ++values;
            lowest = std::min(lowest, value);
            highest = std::max(highest, value);
            return;
        }
        if (notFinite++ == 0) firstNotFinite = Vec3i(voxel.x(), voxel.y(), voxel.z());
    }

    void add(const Leaf& leaf)
    {
        const float* data = leaf.buffer().data();
        float low = data[0];
        float high = data[0];
        float sum = 0.0f; // stays 0 unless a value is not finite
        for (openvdb::Index v = 0; v < Leaf::SIZE; ++v) {
            low = std::min(low, data[v]);
            high = std::max(high, data[v]);
            sum += data[v] * 0.0f;
        }
        if (sum == 0.0f) {
            values += Leaf::SIZE;
            lowest = std::min(lowest, low);
            highest = std::max(highest, high);
            return;
        }
        for (openvdb::Index v = 0; v < Leaf::SIZE; ++v) add(data[v], leaf.offsetToGlobalCoord(v));
    }
};

// As many leaves as the tile's sides have where they meet a tile of another value, by the middles of the sides.
std::uint64_t bareLeavesOf(const openvdb::CoordBBox& box, float value, openvdb::FloatGrid::ConstAccessor& accessor)
{
    const std::uint64_t leavesAlong = std::uint64_t(box.dim().x()) / Leaf::DIM;
    if (leavesAlong <= 1) return 0;
    const openvdb::Coord middle = box.min().offsetBy(box.dim().x() / 2);
    std::uint64_t count = 0;
    for (int side = 0; side < 6; ++side) {
        openvdb::Coord beyond = middle;
        const bool low = side % 2 == 0;
        // Space ends there.
        if (low ? box.min()[side / 2] == std::numeric_limits<int>::min()
                : box.max()[side / 2] == std::numeric_limits<int>::max())
            continue;
        beyond[side / 2] = low ? box.min()[side / 2] - 1 : box.max()[side / 2] + 1;
        if (accessor.probeConstLeaf(beyond) == nullptr && accessor.getValue(beyond) != value)
            count += leavesAlong * leavesAlong;
    }
    return count;
}

} // namespace

ValueRange valueRange(const ScalarGrid& handle)
{
    const openvdb::FloatGrid& grid = toOpenVdb(handle);
    std::vector<const Leaf*> leaves;
    grid.tree().getNodes(leaves);
    Range range = reduceBlocks(leaves.size(), kLeavesPerTask, Range{}, [&](IndexRange part) {
        Range sum;
        for (std::size_t i = part.begin; i < part.end; ++i) sum.add(*leaves[i]);
        return sum;
    });
    auto tile = grid.cbeginValueAll();
    tile.setMaxDepth(openvdb::FloatGrid::ValueAllCIter::LEAF_DEPTH - 1);
    auto accessor = grid.getConstAccessor();
    for (; tile; ++tile) {
        if (*tile == grid.background() && !tile.isValueOn()) continue;
        range.add(*tile, tile.getCoord());
        range.bareLeaves += bareLeavesOf(tile.getBoundingBox(), *tile, accessor);
    }
    if (range.values == 0) range.lowest = range.highest = 0.0f;
    return range;
}

} // namespace vdbounce
