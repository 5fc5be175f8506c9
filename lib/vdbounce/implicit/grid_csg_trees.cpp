// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/grid_csg_trees.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/implicit/grid_csg_leaf.h"
#include "vdbounce/implicit/grid_csg_node.h"

#include <cstdint>
#include <set>
#include <type_traits>
#include <vector>

namespace vdbounce {
namespace {

using Tree = openvdb::FloatTree;
using Root = Tree::RootNodeType;
using Upper = Root::ChildNodeType; // 4096 voxels a side
using openvdb::Coord;
using openvdb::Index;

// Leaves that a task combines: some 20 microseconds.
constexpr std::size_t kLeavesPerTask = 32;

// What a node's entry holds; of a tile what the tile does.
template <class Node> CsgPiece<typename Node::ChildNodeType> entryOf(const CsgPiece<Node>& piece, Index n)
{
    if (piece.node == nullptr) return {nullptr, piece.value, piece.active};
    const auto& entry = piece.node->getTable()[n];
    if (piece.node->isChildMaskOn(n)) return {entry.getChild(), 0.0f, false};
    return {nullptr, entry.getValue(), piece.node->getValueMask().isOn(n)};
}

template <class Node> bool hasNode(const CsgPiece<Node>& piece, Index n)
{
    return piece.node != nullptr && piece.node->isChildMaskOn(n);
}

// Entries whose masks are a word.
constexpr Index kWordEntries = 64;

// True where a word's entries are inactive tiles of one value, as most are: they are compared many at once.
template <class Node> bool isOneTile(const CsgPiece<Node>& piece, Index word)
{
    using Word = openvdb::Index64;
    if (piece.node == nullptr) return true;
    if (piece.node->getChildMask().template getWord<Word>(word) != 0) return false;
    if (piece.node->getValueMask().template getWord<Word>(word) != 0) return false;
    const auto* entries = piece.node->getTable() + word * kWordEntries;
    const float value = entries[0].getValue();
    std::int32_t other = 0;
    for (Index n = 1; n < kWordEntries; ++n) other |= std::int32_t(entries[n].getValue() != value);
    return other == 0;
}

class TreeCombination {
public:
    TreeCombination(const CsgRule& rule, const Progress& progress) : rule_(rule), progress_(progress) {}

    template <class Node>
    CsgMade<Node> combine(const CsgPiece<Node>& a, const CsgPiece<Node>& b, const Coord& origin) const
    {
        if (a.node == nullptr && b.node == nullptr) return combineTiles(rule_, a, b);
        if ((a.node == nullptr && rule_.signA * a.value <= rule_.low) ||
            (b.node == nullptr && rule_.signB * b.value <= rule_.low)) {
            return {nullptr, rule_.signOut * rule_.low, false};
        }
        if constexpr (std::is_same_v<Node, CsgLeaf>) {
            return combineLeaves(rule_, a, b, origin);
        } else {
            return combineInner(a, b, origin);
        }
    }

private:
    template <class Node>
    CsgMade<Node> combineInner(const CsgPiece<Node>& a, const CsgPiece<Node>& b, const Coord& origin) const
    {
        using Child = typename Node::ChildNodeType;
        constexpr bool kOfLeaves = std::is_same_v<Child, CsgLeaf>;
        throwIfStopped(progress_);
        NodeInMaking<Node> node(origin, combineTiles(rule_, entryOf(a, 0), entryOf(b, 0)).value);
        const std::vector<Index> withNodes = combineEntries(a, b, node);
        std::vector<CsgMade<Child>> made(withNodes.size());
        forEachIndex(withNodes.size(), kOfLeaves ? kLeavesPerTask : 1, [&](std::size_t i) {
            const Index n = withNodes[i];
            Coord corner;
            Node::offsetToLocalCoord(n, corner);
            made[i] = combine(entryOf(a, n), entryOf(b, n), origin + (corner << std::size_t(Child::TOTAL)));
        });
        for (std::size_t i = 0; i < made.size(); ++i) node.set(withNodes[i], std::move(made[i]));
        return node.finished();
    }

    // Combines the entries that are tiles in both into `node`; returns the others.
    template <class Node>
    std::vector<Index> combineEntries(const CsgPiece<Node>& a, const CsgPiece<Node>& b, NodeInMaking<Node>& node) const
    {
        std::vector<Index> withNodes;
        for (Index word = 0; word < Node::NUM_VALUES / kWordEntries; ++word) {
            const Index first = word * kWordEntries;
            const bool same = isOneTile(a, word) && isOneTile(b, word);
            if (same && node.holds(combineTiles(rule_, entryOf(a, first), entryOf(b, first)))) continue;
            for (Index n = first; n < first + kWordEntries; ++n) {
                if (hasNode(a, n) || hasNode(b, n)) {
                    withNodes.push_back(n);
                } else {
                    node.set(n, combineTiles(rule_, entryOf(a, n), entryOf(b, n)));
                }
            }
        }
        return withNodes;
    }

    const CsgRule& rule_;
    const Progress& progress_;
};

// The cubes of which any of the roots says something.
std::vector<Coord> cubesOf(const Root& a, const Root& b)
{
    std::set<Coord> cubes;
    for (const Root* root : {&a, &b}) {
        for (auto child = root->cbeginChildOn(); child; ++child) cubes.insert(child.getCoord());
        for (auto tile = root->cbeginValueAll(); tile; ++tile) cubes.insert(tile.getCoord());
    }
    return {cubes.begin(), cubes.end()};
}

CsgPiece<Upper> pieceAt(const Root& root, const Coord& cube)
{
    if (const Upper* node = root.probeConstNode<Upper>(cube)) return {node, 0.0f, false};
    return {nullptr, root.getValue(cube), root.isValueOn(cube)};
}

constexpr float kNoDepth = std::numeric_limits<float>::infinity();

// The depth of the first inactive tile inside of any node of a level.
template <class Node> float depthOfTiles(const Tree& tree)
{
    std::vector<const Node*> nodes;
    tree.getNodes(nodes);
    for (const Node* node : nodes) {
        for (Index n = 0; n < Node::NUM_VALUES; ++n) {
            if (node->isChildMaskOn(n) || node->getValueMask().isOn(n)) continue;
            if (node->getTable()[n].getValue() < 0.0f) return -node->getTable()[n].getValue();
        }
    }
    return kNoDepth;
}

float depthOfLeaves(const Tree& tree)
{
    struct Depth {
        float value = kNoDepth;
        Depth& operator+=(const Depth& other)
        {
            value = std::min(value, other.value);
            return *this;
        }
    };
    std::vector<const CsgLeaf*> leaves;
    tree.getNodes(leaves);
    return reduceBlocks(leaves.size(), kLeavesPerTask, Depth{},
                        [&](IndexRange range) {
                            Depth depth;
                            for (std::size_t i = range.begin; i < range.end; ++i) {
                                for (auto voxel = leaves[i]->cbeginValueOff(); voxel; ++voxel) {
                                    if (*voxel < 0.0f) depth += Depth{-*voxel};
                                }
                            }
                            return depth;
                        })
        .value;
}

} // namespace

CsgBand csgBandOf(const openvdb::FloatGrid& grid)
{
    using Lower = Upper::ChildNodeType;
    CsgBand band;
    band.exterior = grid.background();
    band.interior = depthOfTiles<Lower>(grid.tree());
    if (std::isinf(band.interior)) band.interior = depthOfTiles<Upper>(grid.tree());
    if (std::isinf(band.interior)) band.interior = depthOfLeaves(grid.tree());
    return band;
}

Tree::Ptr combineTrees(const CsgRule& rule, const Tree& a, const Tree& b, const Progress& progress)
{
    const TreeCombination combination(rule, progress);
    const std::vector<Coord> cubes = cubesOf(a.root(), b.root());
    std::vector<CsgMade<Upper>> made(cubes.size());
    forEachIndex(cubes.size(), 1, [&](std::size_t i) {
        made[i] = combination.combine(pieceAt(a.root(), cubes[i]), pieceAt(b.root(), cubes[i]), cubes[i]);
    });
    auto tree = std::make_shared<Tree>(rule.band().exterior);
    for (std::size_t i = 0; i < cubes.size(); ++i) {
        if (made[i].node != nullptr) {
            tree->root().addChild(made[i].node.release());
        } else if (made[i].active || made[i].value != tree->background()) {
            tree->root().addTile(cubes[i], made[i].value, made[i].active);
        }
    }
    return tree;
}

} // namespace vdbounce
