// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/grid_csg_distance.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/field/distance_field.h"
#include "vdbounce/implicit/grid_csg_complement.h"
#include "vdbounce/implicit/grid_csg_trees.h"
#include "vdbounce/implicit/redistance.h"

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

using openvdb::FloatGrid;
using Leaf = openvdb::FloatTree::LeafNodeType;

constexpr std::size_t kLeavesPerTask = 64;

std::vector<const Leaf*> leavesOf(const FloatGrid& grid)
{
    std::vector<const Leaf*> leaves;
    grid.tree().getNodes(leaves);
    return leaves;
}

// The same tree, for changes: nobody else holds it.
FloatGrid::Ptr unshared(const LevelSetGrid& grid) { return std::const_pointer_cast<FloatGrid>(grid.holder().grid); }

// Active voxels of `known` take their values back.
void restore(const FloatGrid& known, FloatGrid& grid)
{
    const std::vector<const Leaf*> from = leavesOf(known);
    std::vector<Leaf*> to;
    for (const Leaf* leaf : from) to.push_back(leaf->isEmpty() ? nullptr : grid.tree().touchLeaf(leaf->origin()));
    forEachIndex(from.size(), kLeavesPerTask, [&](std::size_t i) {
        if (to[i] == nullptr) return;
        for (auto voxel = from[i]->cbeginValueOn(); voxel; ++voxel) to[i]->setValueOn(voxel.pos(), *voxel);
    });
}

} // namespace

bool hasVoxelInside(const FloatGrid& grid)
{
    for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
        const float* values = leaf->buffer().data();
        if (*std::min_element(values, values + Leaf::SIZE) < 0.0f) return true;
    }
    return false;
}

FloatGrid::Ptr redistanced(const FloatGrid& grid, const CsgBand& band, Progress& progress)
{
    if (endlessBox(grid)) {
        const CsgBand turned{band.interior, band.exterior};
        return complementOf(*redistanced(*complementOf(grid, progress), turned, progress), progress);
    }
    if (!hasVoxelInside(grid)) return levelSetLike(grid, std::make_shared<openvdb::FloatTree>(band.exterior));
    RedistanceOptions options;
    options.exterior = Length{double(band.exterior), false};
    options.interior = Length{double(std::isinf(band.interior) ? band.exterior : band.interior), false};
    return unshared(redistance(toScalarGrid(FloatGrid::ConstPtr(grid.copy())), options, progress));
}

FloatGrid::ConstPtr widened(const FloatGrid::ConstPtr& grid, const CsgBand& band, Progress& progress)
{
    const CsgBand present = csgBandOf(*grid);
    if (present.exterior >= band.exterior && present.interior >= band.interior) return grid;
    if (endlessBox(*grid)) {
        const CsgBand turned{band.interior, band.exterior};
        return complementOf(*widened(complementOf(*grid, progress), turned, progress), progress);
    }
    const LevelSetGrid handle = toLevelSetGrid(grid, "grid '" + grid->getName() + "'");
    if (!hasVoxelInside(*grid) || DistanceField(handle).clipped()) return grid;
    CsgBand wide;
    wide.exterior = std::max(band.exterior, present.exterior);
    wide.interior = std::isinf(present.interior) ? wide.exterior : std::max(band.interior, present.interior);
    const FloatGrid::Ptr result = redistanced(*grid, wide, progress);
    restore(*grid, *result);
    return result;
}

} // namespace vdbounce
