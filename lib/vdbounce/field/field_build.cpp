// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/field_build.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/parallel.h"
#include "vdbounce/io/number_text.h"
#include "vdbounce/io/openvdb_grid.h"

#include <cmath>
#include <limits>

namespace vdbounce {
namespace {

using openvdb::Coord;
using openvdb::FloatGrid;

constexpr std::size_t kLeavesPerTask = 32;

LinearTransform toLinearTransform(const openvdb::math::Transform& transform)
{
    Mat3d matrix;
    const auto toVec = [](const openvdb::Vec3d& v) { return Vec3d(v.x(), v.y(), v.z()); };
    const Vec3d origin = toVec(transform.indexToWorld(openvdb::Vec3d(0.0)));
    const auto map = transform.baseMap()->getAffineMap();
    const openvdb::Mat4d affine = map->getMat4(); // row vectors: world = index * affine
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) matrix(column, row) = affine(row, column);
    }
    return LinearTransform(matrix, origin);
}

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

// Copies a leaf with its halo. The accessor makes neighbouring leaves cheap to find.
void fillBlock(const FloatGrid& grid, FloatGrid::ConstAccessor& accessor, const Vec3i& origin, float* block)
{
    const int low = -LeafBlocks::kHaloBelow;
    const int high = low + LeafBlocks::kBlockRows;
    for (int x = low; x < high; ++x) {
        for (int y = low; y < high; ++y) {
            for (int z = low; z < high; ++z) {
                const Coord voxel(origin.x() + x, origin.y() + y, origin.z() + z);
                const float value = accessor.getValue(voxel);
                if (!std::isfinite(value)) refuseValue(grid, voxel, value);
                *block++ = value;
            }
            *block++ = 0.0f; // the row's padding
        }
    }
}

// The largest squared world length of an index-space gradient with |g_i| <= change_i. Convex, so it is at a corner.
double steepestOf(const Vec3d& change, const LinearTransform& transform)
{
    double steepest = 0.0;
    for (int signs = 0; signs < 4; ++signs) {
        const Vec3d g(change.x(), (signs & 1) != 0 ? -change.y() : change.y(),
                      (signs & 2) != 0 ? -change.z() : change.z());
        steepest = std::max(steepest, transform.gradientToWorld(g).squaredNorm());
    }
    return steepest;
}

// The squared world length of the largest gradient in any cell that touches the block's voxels.
double steepestCell(const float* block, const LinearTransform& transform)
{
    constexpr int kCells = LeafBlocks::kBlockRows - 1;
    double steepest = 0.0;
    for (int x = 0; x < kCells; ++x) {
        for (int y = 0; y < kCells; ++y) {
            for (int z = 0; z < kCells; ++z) {
                const float* v = block + x * LeafBlocks::kStrideX + y * LeafBlocks::kStrideY + z;
                const auto largest = [&](int along, int a, int b) {
                    return std::max(std::max(std::abs(v[along] - v[0]), std::abs(v[along + a] - v[a])),
                                    std::max(std::abs(v[along + b] - v[b]), std::abs(v[along + a + b] - v[a + b])));
                };
                constexpr int kX = LeafBlocks::kStrideX;
                constexpr int kY = LeafBlocks::kStrideY;
                const Vec3d change(largest(kX, kY, 1), largest(kY, kX, 1), largest(1, kX, kY));
                steepest = std::max(steepest, steepestOf(change, transform));
            }
        }
    }
    return steepest;
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

FieldParts buildFieldParts(const LevelSetGrid& handle)
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
    parts.blocks.link();
    forEachBlock(parts.blocks.blockCount(), kLeavesPerTask, [&](std::size_t, IndexRange range) {
        auto accessor = grid.getConstAccessor();
        for (std::size_t i = range.begin; i < range.end; ++i) {
            fillBlock(grid, accessor, parts.blocks.origins()[i], parts.blocks.blockForWriting(i));
        }
    });
    return parts;
}

double lipschitzBound(const LeafBlocks& blocks, const LinearTransform& transform)
{
    std::vector<double> steepest(vdbounce::blockCount(blocks.blockCount(), kLeavesPerTask), 1.0);
    forEachBlock(blocks.blockCount(), kLeavesPerTask, [&](std::size_t task, IndexRange range) {
        for (std::size_t i = range.begin; i < range.end; ++i) {
            steepest[task] = std::max(steepest[task], steepestCell(blocks.block(i), transform));
        }
    });
    // Where tiles of different value meet there is no leaf, and the whole difference lies in one cell.
    double largest = std::max(1.0, steepestOf(Vec3d::Constant(double(blocks.largestTileStep())), transform));
    for (double value : steepest) largest = std::max(largest, value);
    return std::sqrt(largest);
}

} // namespace vdbounce
