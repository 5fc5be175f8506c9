// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/field_build.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/parallel.h"
#include "vdbounce/field/lipschitz.h"
#include "vdbounce/field/openvdb_transform.h"
#include "vdbounce/io/number_text.h"
#include "vdbounce/io/openvdb_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vdbounce {
namespace {

using openvdb::Coord;
using openvdb::FloatGrid;

constexpr std::size_t kLeavesPerTask = 32;

Vec3i toVec3i(const Coord& c) { return Vec3i(c.x(), c.y(), c.z()); }

[[noreturn]] void refuseValue(const FloatGrid& grid, const Coord& voxel, float value)
{
    throw InputError("grid '" + grid.getName() + "'",
                     "voxel (" + std::to_string(voxel.x()) + ", " + std::to_string(voxel.y()) + ", " +
                         std::to_string(voxel.z()) + ") holds " + numberText(double(value)),
                     "a level set's values are finite; write the grid again");
}

void setTiles(const FloatGrid& grid, LeafBlocks& blocks)
{
    auto it = grid.cbeginValueAll();
    it.setMaxDepth(FloatGrid::ValueAllCIter::LEAF_DEPTH - 1);
    for (; it; ++it) {
        if (*it == grid.background() && !it.isValueOn()) continue;
        if (!std::isfinite(*it)) refuseValue(grid, it.getCoord(), *it);
        const openvdb::CoordBBox box = it.getBoundingBox();
        blocks.setTiles(toVec3i(box.min()), toVec3i(box.max()), *it);
    }
}

// The stretch of a block's rows that comes from the leaf `side` (-1, 0, 1) of its own along an axis, and where in that
// leaf it begins.
struct Stretch {
    int begin;
    int end;
    int from;
};

Stretch stretchOf(int side)
{
    constexpr int kOwn = BlockLayout::kHaloBelow;
    constexpr int kAfter = kOwn + BlockLayout::kLeafSide;
    if (side < 0) return {0, kOwn, BlockLayout::kLeafSide - kOwn};
    if (side == 0) return {kOwn, kAfter, 0};
    return {kAfter, BlockLayout::kRows, 0};
}

// Copies what a block takes from one of the 27 leaves around it; `leaf` is null where that is a tile of `value`.
void copyFrom(const FloatGrid::TreeType::LeafNodeType* leaf, float value, const Vec3i& side, float* block)
{
    const Stretch x = stretchOf(side.x());
    const Stretch y = stretchOf(side.y());
    const Stretch z = stretchOf(side.z());
    const float* source = leaf != nullptr ? leaf->buffer().data() : nullptr;
    for (int i = x.begin; i < x.end; ++i) {
        for (int j = y.begin; j < y.end; ++j) {
            float* row = block + i * BlockLayout::kStrideX + j * BlockLayout::kStrideY + z.begin;
            if (source == nullptr) {
                std::fill_n(row, z.end - z.begin, value);
                continue;
            }
            const int place =
                ((x.from + i - x.begin) * BlockLayout::kLeafSide + y.from + j - y.begin) * BlockLayout::kLeafSide +
                z.from;
            std::copy_n(source + place, z.end - z.begin, row);
        }
    }
}

// A block's values from the leaf at `origin` and its 26 neighbours. The accessor makes neighbouring leaves cheap to
// find.
void gatherBlock(FloatGrid::ConstAccessor& accessor, const Vec3i& origin, float (&block)[BlockLayout::kSize])
{
    for (int n = 0; n < 27; ++n) {
        const Vec3i side(n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1);
        const Vec3i at = origin + BlockLayout::kLeafSide * side;
        const Coord voxel(at.x(), at.y(), at.z());
        const auto* leaf = accessor.probeConstLeaf(voxel);
        copyFrom(leaf, leaf == nullptr ? accessor.getValue(voxel) : 0.0f, side, block);
    }
}

void requireFinite(const FloatGrid& grid, const Vec3i& origin, const float (&block)[BlockLayout::kSize])
{
    float sum = 0.0f; // stays 0 unless a value is not finite
    for (float value : block) sum += value * 0.0f;
    if (sum == 0.0f) return;
    for (int i = 0; i < BlockLayout::kSize; ++i) {
        if (std::isfinite(block[i])) continue;
        const int plane = i / BlockLayout::kStrideX;
        const int row = i % BlockLayout::kStrideX / BlockLayout::kStrideY;
        const Vec3i voxel =
            origin + Vec3i(plane, row, i % BlockLayout::kStrideY) - Vec3i::Constant(BlockLayout::kHaloBelow);
        refuseValue(grid, Coord(voxel.x(), voxel.y(), voxel.z()), block[i]);
    }
}

// Tiles beside others become blocks where a lookup in them could meet a second value.
void addTilesThatNeedBlocks(const FloatGrid& grid, const std::vector<Vec3i>& tiles, LeafBlocks& blocks)
{
    std::vector<char> needed(tiles.size());
    forEachBlock(tiles.size(), kLeavesPerTask, [&](std::size_t, IndexRange range) {
        auto accessor = grid.getConstAccessor();
        float values[BlockLayout::kSize];
        for (std::size_t i = range.begin; i < range.end; ++i) {
            gatherBlock(accessor, tiles[i], values);
            needed[i] = std::any_of(values, values + BlockLayout::kSize, [&](float v) { return v != values[0]; });
        }
    });
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        if (needed[i]) blocks.addLeaf(tiles[i]);
    }
}

float largestMagnitude(const FloatGrid& grid)
{
    float largest = std::abs(grid.background());
    auto tile = grid.cbeginValueAll();
    tile.setMaxDepth(FloatGrid::ValueAllCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) largest = std::max(largest, std::abs(*tile));
    for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
        const float* values = leaf->buffer().data();
        for (std::size_t i = 0; i < leaf->SIZE; ++i) largest = std::max(largest, std::abs(values[i]));
    }
    return largest;
}

// A block's cells in which lookups within the box read; at the sides of a box that cuts the surface off phi jumps.
// Where the box is flat lookups read the cells to both sides of it.
CellRange cellsRead(const Vec3i& origin, const Box& box, int beyondBox)
{
    CellRange cells;
    if (box.empty()) return cells;
    const Vec3i first = origin - Vec3i::Constant(BlockLayout::kHaloBelow);
    for (int axis = 0; axis < 3; ++axis) {
        const int beyond = box.min[axis] == box.max[axis] ? 1 : beyondBox;
        cells.begin[axis] = std::max(cells.begin[axis], int(box.min[axis]) - beyond - first[axis]);
        cells.end[axis] = std::min(cells.end[axis], int(box.max[axis]) + beyond - first[axis]);
    }
    return cells;
}

// Fills the blocks, and finds out what must be known of every value while it is at hand.
void fillBlocks(const FloatGrid& grid, Storage storage, int beyondBox, FieldParts& parts)
{
    const std::vector<Vec3i>& origins = parts.blocks.origins();
    BlockValues& kept = parts.blocks.valuesForWriting();
    kept.allocate(storage, origins.size(), storage == Storage::Half ? largestMagnitude(grid) : 0.0f);
    std::vector<SurfaceTree::Leaf> leaves(origins.size());
    std::vector<float> errors(blockCount(origins.size(), kLeavesPerTask));
    std::vector<double> steepest(errors.size(), 1.0);
    forEachBlock(origins.size(), kLeavesPerTask, [&](std::size_t task, IndexRange range) {
        auto accessor = grid.getConstAccessor();
        float values[BlockLayout::kSize];
        for (std::size_t i = range.begin; i < range.end; ++i) {
            gatherBlock(accessor, origins[i], values);
            requireFinite(grid, origins[i], values);
            const float error = kept.encode(i, values);
            if (storage != Storage::Float) kept.decode(i, values);
            errors[task] = std::max(errors[task], error);
            steepest[task] =
                steepestCell(values, parts.transform, steepest[task], cellsRead(origins[i], parts.indexBox, beyondBox));
            leaves[i] = SurfaceTree::leafOf(values, origins[i], parts.indexBox, parts.transform, error);
        }
    });
    double steepestOfAll = 1.0;
    for (double value : steepest) steepestOfAll = std::max(steepestOfAll, value);
    parts.lipschitz = std::sqrt(steepestOfAll);
    for (float error : errors) parts.storageError = std::max(parts.storageError, error);
    parts.surface = SurfaceTree(leaves, parts.transform);
}

// The smallest depth that an inactive voxel or tile inside claims: only that much is sure of any of them.
float interiorClamp(const FloatGrid& grid)
{
    float clamp = std::numeric_limits<float>::infinity();
    for (auto it = grid.cbeginValueOff(); it; ++it) {
        if (*it < 0.0f) clamp = std::min(clamp, -*it);
    }
    return clamp;
}

} // namespace

FieldParts buildFieldParts(const LevelSetGrid& handle, Storage storage, int beyondBox)
{
    const FloatGrid& grid = toOpenVdb(handle);
    FieldParts parts;
    parts.transform = toLinearTransform(grid.transform());
    parts.background = grid.background();
    parts.blocks = LeafBlocks(grid.background());
    const openvdb::CoordBBox active = grid.evalActiveVoxelBoundingBox();
    if (!active.empty()) {
        parts.indexBox = Box{toVec3i(active.min()).cast<double>(), toVec3i(active.max()).cast<double>()};
    }

    for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) parts.blocks.addLeaf(toVec3i(leaf->origin()));
    setTiles(grid, parts.blocks);
    parts.interior = interiorClamp(grid);
    addTilesThatNeedBlocks(grid, parts.blocks.link(), parts.blocks);
    fillBlocks(grid, storage, beyondBox, parts);
    return parts;
}

} // namespace vdbounce
