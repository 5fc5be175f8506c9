// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/leaf_collector.h"

#include "vdbounce/field/grid_assembly.h"
#include "vdbounce/implicit/leaf_limit.h"
#include "vdbounce/implicit/leaf_tiles.h"
#include "vdbounce/io/vdb_archive.h"

#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <mutex>

namespace vdbounce {
namespace {

using Tree = openvdb::FloatTree;
using Leaf = Tree::LeafNodeType;

} // namespace

struct LeafCollector::Parts {
    std::mutex adding;
    std::vector<std::unique_ptr<Leaf>> leaves;
    std::vector<LeafCube> inside;
};

LeafCollector::LeafCollector(std::uint64_t maxLeaves) : parts_(std::make_unique<Parts>()), maxLeaves_(maxLeaves)
{
    initializeOpenVdb();
}

LeafCollector::~LeafCollector() = default;

void LeafCollector::add(const Vec3i& leaf, const float* values, const std::uint64_t (&active)[8])
{
    // Without a buffer until it is filled whole.
    auto target = std::make_unique<Leaf>(openvdb::PartialCreate(), originOfLeaf(leaf), 0.0f);
    target->allocate();
    std::copy_n(values, Leaf::SIZE, target->buffer().data());
    Leaf::NodeMaskType mask;
    for (openvdb::Index x = 0; x < 8; ++x) mask.getWord<openvdb::Index64>(x) = active[x];
    target->setValueMask(mask);
    const std::lock_guard<std::mutex> lock(parts_->adding);
    requireLeaves(parts_->leaves.size() + 1, maxLeaves_);
    parts_->leaves.push_back(std::move(target));
}

void LeafCollector::addInside(const LeafCube& cube)
{
    const std::lock_guard<std::mutex> lock(parts_->adding);
    parts_->inside.push_back(cube);
}

LevelSetGrid LeafCollector::levelSet(float background, double voxelSize, const std::string& name)
{
    auto grid =
        makeGrid<openvdb::FloatGrid>(background, LinearTransform(voxelSize * Mat3d::Identity(), Vec3d::Zero()), name);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    // Which comes first makes no difference to the tree.
    for (const LeafCube& cube : parts_->inside) addTiles(grid->tree(), cube, -background);
    for (auto& leaf : parts_->leaves) grid->tree().addLeaf(leaf.release());
    parts_ = std::make_unique<Parts>();
    // Tiles that fill a node become one.
    openvdb::tools::prune(grid->tree());
    return toLevelSetGrid(grid, name);
}

} // namespace vdbounce
