// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/level_set_assembly.h"

#include "vdbounce/field/grid_assembly.h"
#include "vdbounce/io/vdb_archive.h"

#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

openvdb::Coord originOf(const BandLeaf& leaf)
{
    const Vec3i origin = leaf.voxel(0);
    return openvdb::Coord(origin.x(), origin.y(), origin.z());
}

std::unique_ptr<openvdb::FloatTree::LeafNodeType> levelSetLeaf(const BandLeaf& leaf, const BandWidths& band)
{
    // Without a buffer until it is filled whole.
    auto target = std::make_unique<openvdb::FloatTree::LeafNodeType>(originOf(leaf), band.exterior);
    float* values = target->buffer().data();
    openvdb::FloatTree::LeafNodeType::NodeMaskType active;
    for (openvdb::Index v = 0; v < openvdb::Index(BandLeaf::kVoxels); ++v) {
        const float phi = leaf.distance[v];
        const bool within = phi < band.exterior && phi > -band.interior;
        values[v] = within ? phi : (phi > 0.0f ? band.exterior : -band.interior);
        if (within) active.setOn(v);
    }
    target->setValueMask(active);
    return target;
}

SidecarGrid closestGrid(const BandLeaves& leaves, const BandWidths& band, const LinearTransform& transform,
                        const std::string& name)
{
    using Leaf = openvdb::Int32Tree::LeafNodeType;
    auto grid = makeGrid<openvdb::Int32Grid>(-1, transform, name);
    addLeaves(*grid, leaves.size(), [&](std::size_t i) {
        const BandLeaf& leaf = *leaves[i];
        auto target = std::make_unique<Leaf>(originOf(leaf), -1);
        for (openvdb::Index v = 0; v < openvdb::Index(BandLeaf::kVoxels); ++v) {
            const float phi = leaf.distance[v];
            if (phi < band.exterior && phi > -band.interior)
                target->setValueOn(v, static_cast<std::int32_t>((*leaf.triangle)[v]));
        }
        return target->isEmpty() ? nullptr : std::move(target);
    });
    return toSidecarGrid(grid);
}

SidecarGrid confidenceGrid(const BandLeaves& leaves, const BandWidths& band, const LinearTransform& transform,
                           const std::string& name)
{
    using Leaf = openvdb::FloatTree::LeafNodeType;
    auto grid = makeGrid<openvdb::FloatGrid>(1.0f, transform, name);
    addLeaves(*grid, leaves.size(), [&](std::size_t i) {
        const BandLeaf& leaf = *leaves[i];
        auto target = std::make_unique<Leaf>(originOf(leaf), 1.0f);
        for (openvdb::Index v = 0; v < openvdb::Index(BandLeaf::kVoxels); ++v) {
            const float phi = leaf.distance[v];
            if (phi < band.exterior && phi > -band.interior)
                target->setValueOn(v, leaf.confidence != nullptr ? (*leaf.confidence)[v] : 1.0f);
        }
        return target->isEmpty() ? nullptr : std::move(target);
    });
    return toSidecarGrid(grid);
}

} // namespace

AssembledGrids assembleLevelSet(BandLeaves leaves, const std::vector<InsideRun>& inside,
                                const LinearTransform& transform, const BandWidths& band, const std::string& name,
                                bool wantConfidence)
{
    initializeOpenVdb();
    AssembledGrids grids;
    if (!leaves.empty() && leaves.front()->triangle != nullptr)
        grids.closest = closestGrid(leaves, band, transform, name + "_closest");
    if (wantConfidence) grids.confidence = confidenceGrid(leaves, band, transform, name + "_confidence");
    auto grid = makeGrid<openvdb::FloatGrid>(band.exterior, transform, name);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    addLeaves(*grid, leaves.size(), [&](std::size_t i) {
        auto target = levelSetLeaf(*leaves[i], band);
        leaves[i].reset();
        return target;
    });
    for (const InsideRun& run : inside) {
        for (int z = run.zBegin; z < run.zEnd; ++z) {
            const Vec3i origin = Vec3i(run.leafX, run.leafY, z) * BandLeaf::kSide;
            grid->tree().addTile(1, openvdb::Coord(origin.x(), origin.y(), origin.z()), -band.interior,
                                 /*active=*/false);
        }
    }
    // Leaves that hold nothing but one side become tiles. (Not pruneLevelSet, which takes a leaf without active voxels
    // for one side by its first voxel, where a hole may open in it.)
    openvdb::tools::prune(grid->tree());
    grids.levelSet = toLevelSetGrid(grid, name);
    return grids;
}

} // namespace vdbounce
