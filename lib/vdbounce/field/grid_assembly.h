// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/parallel.h"
#include "vdbounce/field/openvdb_transform.h"
#include "vdbounce/io/openvdb_grid.h"

#include <memory>
#include <string>
#include <vector>

/// @file
/// Making OpenVDB grids leaf by leaf: leaves are filled in parallel and hung into the tree in order, which is several
/// times as fast as setting voxels.

namespace vdbounce {

/// How many leaves a task fills.
constexpr std::size_t kLeavesPerTask = 64;

/// An empty grid.
template <class GridType>
typename GridType::Ptr makeGrid(const typename GridType::ValueType& background, const LinearTransform& transform,
                                const std::string& name)
{
    auto grid = GridType::create(background);
    grid->setName(name);
    grid->setTransform(toOpenVdb(transform));
    return grid;
}

/// Adds the leaves that `fill(i)`, for i below `count`, returns as unique_ptr, in the order of i; null ones are passed
/// over. `fill` is called from many threads.
template <class GridType, class Fill> void addLeaves(GridType& grid, std::size_t count, const Fill& fill)
{
    using Leaf = typename GridType::TreeType::LeafNodeType;
    std::vector<std::unique_ptr<Leaf>> made(count);
    forEachIndex(count, kLeavesPerTask, [&](std::size_t i) { made[i] = fill(i); });
    for (auto& leaf : made) {
        if (leaf != nullptr) grid.tree().addLeaf(leaf.release());
    }
}

} // namespace vdbounce
