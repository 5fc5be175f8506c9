// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/grid_csg_rule.h"
#include "vdbounce/io/openvdb_grid.h"

#include <memory>

namespace vdbounce {

/// What a tree holds in the cube of a node: a node, or one value for all of its voxels.
template <class Node> struct CsgPiece {
    const Node* node = nullptr;
    float value = 0.0f;
    bool active = false;
};

/// The same of a tree that is being made.
template <class Node> struct CsgMade {
    std::unique_ptr<Node> node;
    float value = 0.0f;
    bool active = false;
};

using CsgLeaf = openvdb::FloatTree::LeafNodeType;

/// Combines two values of tiles.
template <class Node> CsgMade<Node> combineTiles(const CsgRule& rule, const CsgPiece<Node>& a, const CsgPiece<Node>& b)
{
    const float x = rule.signA * a.value;
    const float y = rule.signB * b.value;
    const float least = rule.minimum(x, y);
    const float kept = rule.clamped(least);
    const bool active = (x <= y && a.active) || (y <= x && b.active);
    return {nullptr, rule.signOut * kept, active && kept == least};
}

/// Combines two leaves, or one with a tile, voxel by voxel. A voxel is active where the operand that has the smaller
/// value is, of equal ones either, unless its value is beyond the band. A leaf of nothing but one inactive value
/// becomes a tile.
CsgMade<CsgLeaf> combineLeaves(const CsgRule& rule, const CsgPiece<CsgLeaf>& a, const CsgPiece<CsgLeaf>& b,
                               const openvdb::Coord& origin);

} // namespace vdbounce
