// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/leaf_sample.h"

#include "vdbounce/base/random_numbers.h"
#include "vdbounce/io/openvdb_grid.h"

#include <algorithm>

namespace vdbounce {
namespace {

using Tree = openvdb::FloatTree;
using Leaf = Tree::LeafNodeType;

bool hasBothSides(const Leaf& leaf)
{
    const float* values = leaf.buffer().data();
    const bool inside = values[0] < 0.0f;
    return std::any_of(values, values + Leaf::SIZE, [&](float value) { return (value < 0.0f) != inside; });
}

std::vector<const Leaf*> leavesAtSurface(const Tree& tree)
{
    std::vector<const Leaf*> leaves;
    for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
        if (hasBothSides(*leaf)) leaves.push_back(&*leaf);
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
    for (const Leaf* leaf : spread(leavesAtSurface(toOpenVdb(grid).constTree()), count, seed))
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
