// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/blob_leaves.h"

#include "vdbounce/field/grid_assembly.h"
#include "vdbounce/implicit/leaf_limit.h"
#include "vdbounce/implicit/leaf_tiles.h"
#include "vdbounce/io/vdb_archive.h"

#include <algorithm>
#include <mutex>

namespace vdbounce {
namespace {

using Tree = openvdb::FloatTree;
using Leaf = Tree::LeafNodeType;
using Accessor = openvdb::tree::ValueAccessor<const Tree, false>;

// Voxels from a change of sign that are kept.
constexpr int kKept = 2;

bool isMixed(const Leaf& leaf)
{
    const float* values = leaf.buffer().data();
    const bool first = values[0] < 0.0f;
    return std::any_of(values, values + Leaf::SIZE, [&](float value) { return (value < 0.0f) != first; });
}

// The voxels of the neighbour `step` along an axis that are near.
struct Near {
    int begin;
    int end;
    explicit Near(int step) : begin(step < 0 ? 8 - kKept : 0), end(step > 0 ? kKept : 8) {}
};

// Some of a neighbour's voxels that are near is on the other side.
bool differs(const Leaf& neighbour, const Vec3i& step, bool inside)
{
    const float* values = neighbour.buffer().data();
    const Near xs(step.x());
    const Near ys(step.y());
    const Near zs(step.z());
    for (int x = xs.begin; x < xs.end; ++x) {
        for (int y = ys.begin; y < ys.end; ++y) {
            for (int z = zs.begin; z < zs.end; ++z) {
                if ((values[64 * x + 8 * y + z] < 0.0f) != inside) return true;
            }
        }
    }
    return false;
}

bool isNearSurface(const Leaf& leaf, const Tree& tree)
{
    if (isMixed(leaf)) return true;
    const bool inside = leaf.buffer().data()[0] < 0.0f;
    const Accessor accessor(tree);
    for (int n = 0; n < 27; ++n) {
        const Vec3i step(n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1);
        const Leaf* neighbour =
            accessor.probeConstLeaf(leaf.origin().offsetBy(8 * step.x(), 8 * step.y(), 8 * step.z()));
        if (neighbour != nullptr && neighbour != &leaf && differs(*neighbour, step, inside)) return true;
    }
    return false;
}

// Leaves far from the surface become tiles. Returns how many stay.
std::size_t dropFarLeaves(Tree& tree)
{
    std::vector<const Leaf*> leaves;
    tree.getNodes(leaves);
    std::vector<std::uint8_t> near(leaves.size());
    forEachIndex(leaves.size(), kLeavesPerTask,
                 [&](std::size_t i) { near[i] = isNearSurface(*leaves[i], tree) ? 1 : 0; });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        if (near[i] != 0) {
            ++kept;
            continue;
        }
        const bool inside = leaves[i]->buffer().data()[0] < 0.0f;
        tree.addTile(1, leaves[i]->origin(), inside ? -tree.background() : tree.background(), /*active=*/false);
    }
    return kept;
}

} // namespace

struct BlobLeaves::Parts {
    std::mutex adding;
    std::vector<std::unique_ptr<Leaf>> leaves;
    std::vector<LeafCube> inside;
};

BlobLeaves::BlobLeaves(std::uint64_t maxLeaves) : parts_(std::make_unique<Parts>()), maxLeaves_(maxLeaves)
{
    initializeOpenVdb();
}

BlobLeaves::~BlobLeaves() = default;

void BlobLeaves::add(const Vec3i& leaf, const float* values)
{
    auto target = std::make_unique<Leaf>(openvdb::PartialCreate(), originOfLeaf(leaf), 0.0f, /*active=*/true);
    target->allocate();
    std::copy_n(values, Leaf::SIZE, target->buffer().data());
    const std::lock_guard<std::mutex> lock(parts_->adding);
    requireLeaves(parts_->leaves.size() + 1, maxLeaves_);
    parts_->leaves.push_back(std::move(target));
}

void BlobLeaves::addInside(const LeafCube& cube)
{
    const std::lock_guard<std::mutex> lock(parts_->adding);
    parts_->inside.push_back(cube);
}

std::optional<ScalarGrid> BlobLeaves::implicitGrid(float background, double voxelSize)
{
    auto grid =
        makeGrid<openvdb::FloatGrid>(background, LinearTransform(voxelSize * Mat3d::Identity(), Vec3d::Zero()), "");
    // So that the tiles' signs count.
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    for (const LeafCube& cube : parts_->inside) addTiles(grid->tree(), cube, -background);
    for (auto& leaf : parts_->leaves) grid->tree().addLeaf(leaf.release());
    parts_ = std::make_unique<Parts>();
    if (dropFarLeaves(grid->tree()) == 0) return std::nullopt;
    return toScalarGrid(openvdb::FloatGrid::ConstPtr(grid));
}

} // namespace vdbounce
