// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/grid_csg_leaf.h"

#include <memory>
#include <utility>

namespace vdbounce {

/// An inner node in the making. A node of the upper level takes 256 KB, which costs more than to look at what goes into
/// it: it is made only once an entry differs from the rest.
template <class Node> class NodeInMaking {
public:
    using Child = typename Node::ChildNodeType;

    /// All entries are inactive tiles of that value.
    NodeInMaking(const openvdb::Coord& origin, float filled) : origin_(origin), filled_(filled) {}

    /// True for what all entries are until they are set.
    bool holds(const CsgMade<Child>& entry) const
    {
        return entry.node == nullptr && entry.value == filled_ && !entry.active;
    }

    void set(openvdb::Index n, CsgMade<Child> entry)
    {
        if (holds(entry)) return;
        if (node_ == nullptr) node_ = std::make_unique<Node>(origin_, filled_, false);
        if (entry.node != nullptr) {
            node_->addChild(entry.node.release());
        } else {
            node_->addTile(n, entry.value, entry.active);
        }
    }

    /// The node, or a tile where all entries are the same; each is to have been set.
    CsgMade<Node> finished()
    {
        if (node_ == nullptr) return {nullptr, filled_, false};
        if (!node_->getChildMask().isOff() || !node_->getValueMask().isOff()) return {std::move(node_), 0.0f, false};
        const float value = node_->getTable()[0].getValue();
        for (openvdb::Index n = 1; n < Node::NUM_VALUES; ++n) {
            if (node_->getTable()[n].getValue() != value) return {std::move(node_), 0.0f, false};
        }
        return {nullptr, value, false};
    }

private:
    openvdb::Coord origin_;
    float filled_;
    std::unique_ptr<Node> node_;
};

} // namespace vdbounce
