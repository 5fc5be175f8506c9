// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/implicit_samples.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/parallel.h"
#include "vdbounce/io/number_text.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace vdbounce {
namespace {

using Tree = openvdb::FloatTree;
using Leaf = Tree::LeafNodeType;
using Accessor = openvdb::tree::ValueAccessor<const Tree, false>;

constexpr std::size_t kLeavesPerTask = 64;

Vec3i toVector(const openvdb::Coord& c) { return Vec3i(c.x(), c.y(), c.z()); }
openvdb::Coord toCoord(const Vec3i& v) { return openvdb::Coord(v.x(), v.y(), v.z()); }

bool comesBefore(const Vec3i& a, const Vec3i& b)
{
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

// The range of offsets -1 .. 9 that lies in the neighbour `step` along an axis.
struct Stretch {
    int begin;
    int end;
    explicit Stretch(int step) : begin(step < 0 ? -1 : 8 * step), end(step < 0 ? 0 : (step > 0 ? 10 : 8)) {}
};

// The blocks of 8^3 voxels along the faces of an active tile.
void addShell(const openvdb::CoordBBox& tile, std::vector<Vec3i>& leaves)
{
    const Vec3i low = toVector(tile.min());
    const Vec3i count = (toVector(tile.max()) - low + Vec3i::Ones()) / 8;
    for (int x = 0; x < count.x(); ++x) {
        for (int y = 0; y < count.y(); ++y) {
            const bool face = x == 0 || y == 0 || x + 1 == count.x() || y + 1 == count.y();
            const int step = face ? 1 : std::max(1, count.z() - 1);
            for (int z = 0; z < count.z(); z += step) leaves.push_back(low + 8 * Vec3i(x, y, z));
        }
    }
}

} // namespace

ImplicitSamples::ImplicitSamples(const openvdb::FloatGrid& grid, double iso, Inside inside)
    : grid_(grid), iso_(iso), inside_(inside), inactiveKnown_(inside == Inside::Above),
      sideKnownEverywhere_(inactiveKnown_ || grid.getGridClass() == openvdb::GRID_LEVEL_SET)
{
}

void ImplicitSamples::requireFinite() const
{
    std::vector<const Leaf*> leaves;
    grid_.tree().getNodes(leaves);
    std::vector<std::uint8_t> bad(leaves.size(), 0);
    forEachIndex(leaves.size(), kLeavesPerTask, [&](std::size_t i) {
        const float* values = leaves[i]->buffer().data();
        float sum = 0.0f; // NaN where any is not finite
        for (openvdb::Index v = 0; v < Leaf::SIZE; ++v) sum += values[v] * 0.0f;
        bad[i] = sum == 0.0f ? 0 : 1;
    });
    const auto refuse = [&](const openvdb::Coord& c, float value) {
        throw InputError("grid '" + grid_.getName() + "'",
                         "holds " + numberText(value) + " at voxel " + std::to_string(c.x()) + "," +
                             std::to_string(c.y()) + "," + std::to_string(c.z()),
                         "repair what made it, or make that voxel inactive");
    };
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        if (bad[i] == 0) continue;
        for (auto it = leaves[i]->cbeginValueOn(); it; ++it) {
            if (!std::isfinite(*it)) refuse(it.getCoord(), *it);
        }
    }
    auto tile = grid_.tree().cbeginValueOn();
    tile.setMaxDepth(Tree::ValueOnCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
        if (!std::isfinite(*tile)) refuse(tile.getCoord(), *tile);
    }
}

std::vector<Vec3i> ImplicitSamples::candidateLeaves() const
{
    std::vector<const Leaf*> leaves;
    grid_.tree().getNodes(leaves);
    std::vector<Vec3i> found;
    found.reserve(2 * leaves.size());
    for (const Leaf* leaf : leaves) found.push_back(toVector(leaf->origin()));
    auto tile = grid_.tree().cbeginValueOn();
    tile.setMaxDepth(Tree::ValueOnCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) addShell(tile.getBoundingBox(), found);
    // A cell's lowest corner may lie in a block below that which holds its other corners.
    const Accessor accessor(grid_.tree());
    const std::size_t count = found.size();
    for (std::size_t i = 0; i < count; ++i) {
        for (int n = 1; n < 8; ++n) {
            const Vec3i below = found[i] - 8 * Vec3i(n & 1, n >> 1 & 1, n >> 2);
            if (accessor.probeConstLeaf(toCoord(below)) == nullptr) found.push_back(below);
        }
    }
    std::sort(found.begin(), found.end(), comesBefore);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

void ImplicitSamples::load(const Vec3i& origin, SampleBlock& block) const
{
    const Accessor accessor(grid_.tree());
    block.known.fill(0);
    for (int n = 0; n < 27; ++n) {
        const Vec3i step(n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1);
        const openvdb::Coord from = toCoord(origin + 8 * step);
        const Leaf* leaf = accessor.probeConstLeaf(from);
        const float* values = leaf != nullptr ? leaf->buffer().data() : nullptr;
        const float tile = leaf != nullptr ? 0.0f : toF(accessor.getValue(from));
        const bool tileKnown = leaf == nullptr && (inactiveKnown_ || accessor.isValueOn(from));
        const Stretch xs(step.x());
        const Stretch ys(step.y());
        const Stretch zs(step.z());
        for (int x = xs.begin; x < xs.end; ++x) {
            for (int y = ys.begin; y < ys.end; ++y) {
                const int first = ((x & 7) * 8 + (y & 7)) * 8;
                std::uint16_t known = 0;
                for (int z = zs.begin; z < zs.end; ++z) {
                    const auto v = openvdb::Index(first + (z & 7));
                    block.value[std::size_t(SampleBlock::at(x, y, z))] = leaf != nullptr ? toF(values[v]) : tile;
                    const bool isKnown = leaf != nullptr ? inactiveKnown_ || leaf->isValueOn(v) : tileKnown;
                    if (isKnown) known = std::uint16_t(known | 1 << (z + 1));
                }
                block.known[std::size_t(SampleBlock::row(x, y))] |= known;
            }
        }
    }
    block.allKnown = std::all_of(block.known.begin(), block.known.end(),
                                 [](std::uint16_t bits) { return bits == (1 << SampleBlock::kSide) - 1; });
}

ImplicitSamples::Sides ImplicitSamples::sides(const Vec3i& origin) const
{
    const Accessor accessor(grid_.tree());
    const openvdb::Coord from = toCoord(origin);
    Sides sides;
    const Leaf* leaf = accessor.probeConstLeaf(from);
    if (leaf == nullptr) {
        if (toF(accessor.getValue(from)) < 0.0f) sides.inside.fill(~std::uint64_t(0));
        if (sideKnownEverywhere_ || accessor.isValueOn(from)) sides.known.fill(~std::uint64_t(0));
        return sides;
    }
    const float* values = leaf->buffer().data();
    for (std::size_t x = 0; x < 8; ++x) {
        for (std::size_t i = 0; i < 64; ++i)
            sides.inside[x] |= std::uint64_t(toF(values[64 * x + i]) < 0.0f ? 1 : 0) << i;
        sides.known[x] =
            sideKnownEverywhere_ ? ~std::uint64_t(0) : leaf->getValueMask().getWord<std::uint64_t>(openvdb::Index(x));
    }
    return sides;
}

} // namespace vdbounce
