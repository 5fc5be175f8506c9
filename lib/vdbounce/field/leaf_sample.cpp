// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/leaf_sample.h"

#include "vdbounce/base/random_numbers.h"
#include "vdbounce/io/openvdb_grid.h"

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

using Tree = openvdb::FloatTree;
using Leaf = Tree::LeafNodeType;

// Also where the surface runs between its leaves.
std::vector<const Leaf*> leavesAtSurface(const openvdb::FloatGrid& grid)
{
    const openvdb::Vec3d side = grid.voxelSize();
    const float near = float(std::max({side.x(), side.y(), side.z()}));
    std::vector<const Leaf*> leaves;
    for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
        const float* values = leaf->buffer().data();
        if (std::any_of(values, values + Leaf::SIZE, [&](float value) { return std::abs(value) < near; }))
            leaves.push_back(&*leaf);
    }
    return leaves;
}

// One of each of `count` stretches of equal length.
std::vector<const Leaf*> spread(const std::vector<const Leaf*>& all, std::size_t count, std::uint64_t seed)
{
    if (all.size() <= count) return all;
    std::vector<const Leaf*> some(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double at = (double(i) + CounterRandom(seed, i).uniform()) / double(count);
        some[i] = all[std::min(all.size() - 1, std::size_t(at * double(all.size())))];
    }
    return some;
}

void copyPlace(const Tree& from, const openvdb::Coord& origin, Tree& to)
{
    if (to.probeConstLeaf(origin) != nullptr) return;
    if (const Leaf* leaf = from.probeConstLeaf(origin)) {
        to.addLeaf(new Leaf(*leaf));
    } else {
        to.addTile(1, origin, from.getValue(origin), from.isValueOn(origin));
    }
}

} // namespace

std::vector<Vec3i> sampleLeaves(const LevelSetGrid& grid, std::size_t count, std::uint64_t seed)
{
    std::vector<Vec3i> origins;
    for (const Leaf* leaf : spread(leavesAtSurface(toOpenVdb(grid)), count, seed))
        origins.emplace_back(leaf->origin().x(), leaf->origin().y(), leaf->origin().z());
    return origins;
}

LevelSetGrid cutOut(const LevelSetGrid& grid, const std::vector<Vec3i>& leaves)
{
    constexpr int kSide = int(Leaf::DIM);
    const openvdb::FloatGrid& whole = toOpenVdb(grid);
    const openvdb::FloatGrid::Ptr pieces = whole.copyWithNewTree();
    for (const Vec3i& leaf : leaves) {
        for (int i = 0; i < 27; ++i) {
            const Vec3i place = leaf + kSide * Vec3i(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1);
            copyPlace(whole.constTree(), openvdb::Coord(place.x(), place.y(), place.z()), pieces->tree());
        }
    }
    return toLevelSetGrid(pieces, "pieces of a level set");
}

} // namespace vdbounce
