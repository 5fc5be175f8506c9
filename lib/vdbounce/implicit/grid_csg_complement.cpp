// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/grid_csg_complement.h"

#include "vdbounce/implicit/grid_csg_trees.h"

#include <cmath>

namespace vdbounce {
namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::FloatGrid;
using openvdb::FloatTree;

constexpr int kLeafSide = int(FloatTree::LeafNodeType::DIM);

// Of the box's metadata, index space, both ends inclusive.
constexpr const char* kBoxMin = "vdbounce_endless_min";
constexpr const char* kBoxMax = "vdbounce_endless_max";

CoordBBox inWholeLeaves(const CoordBBox& box)
{
    const Coord high = box.max() & ~(kLeafSide - 1);
    return CoordBBox(box.min() & ~(kLeafSide - 1), high.offsetBy(kLeafSide - 1));
}

// Inside with the band's depth in the box, outside everywhere else.
FloatTree boxTree(const CoordBBox& box, const CsgBand& band)
{
    FloatTree tree(band.exterior);
    tree.sparseFill(box, -band.interior, /*active=*/false);
    return tree;
}

} // namespace

std::optional<CoordBBox> endlessBox(const FloatGrid& grid)
{
    const auto min = grid.getMetadata<openvdb::Vec3IMetadata>(kBoxMin);
    const auto max = grid.getMetadata<openvdb::Vec3IMetadata>(kBoxMax);
    if (!min || !max) return std::nullopt;
    const CoordBBox box(Coord(min->value()), Coord(max->value()));
    if (box.empty()) return std::nullopt;
    return inWholeLeaves(box);
}

void setEndlessBox(FloatGrid& grid, const std::optional<CoordBBox>& box)
{
    grid.removeMeta(kBoxMin);
    grid.removeMeta(kBoxMax);
    if (!box) return;
    grid.insertMeta(kBoxMin, openvdb::Vec3IMetadata(box->min().asVec3i()));
    grid.insertMeta(kBoxMax, openvdb::Vec3IMetadata(box->max().asVec3i()));
}

CoordBBox paddedBox(const FloatGrid& grid)
{
    CoordBBox box;
    grid.tree().evalLeafBoundingBox(box);
    auto tile = grid.cbeginValueAll();
    tile.setMaxDepth(FloatGrid::ValueAllCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
        if (*tile < 0.0f || tile.isValueOn()) box.expand(tile.getBoundingBox());
    }
    if (box.empty()) return box;
    const openvdb::Vec3d voxel = grid.voxelSize();
    const double side = std::min(voxel[0], std::min(voxel[1], voxel[2]));
    box.expand(kLeafSide + int(std::ceil(double(grid.background()) / side)));
    return inWholeLeaves(box);
}

FloatGrid::Ptr complementOf(const FloatGrid& grid, const Progress& progress)
{
    const std::optional<CoordBBox> ends = endlessBox(grid);
    const CoordBBox box = ends ? *ends : paddedBox(grid);
    const CsgBand band = csgBandOf(grid);
    CsgBand turned;
    turned.exterior = std::isinf(band.interior) ? band.exterior : band.interior;
    turned.interior = band.exterior;
    // What is not in the body is what the box has without it.
    const CsgRule rule(CsgOperation::Subtraction, turned, band, 0.0f);
    auto result = levelSetLike(grid, combineTrees(rule, boxTree(box, turned), grid.tree(), progress));
    if (!ends) setEndlessBox(*result, box);
    return result;
}

FloatGrid::ConstPtr reachingTo(const FloatGrid::ConstPtr& grid, const CoordBBox& box, const Progress& progress)
{
    const std::optional<CoordBBox> ends = endlessBox(*grid);
    if (!ends || box.empty() || ends->isInside(box)) return grid;
    CoordBBox wider = *ends;
    wider.expand(box);
    CsgBand band = csgBandOf(*grid);
    if (std::isinf(band.interior)) band.interior = band.exterior;
    FloatTree added = boxTree(wider, band);
    added.sparseFill(*ends, band.exterior, /*active=*/false);
    const CsgRule rule(CsgOperation::Union, band, band, 0.0f);
    auto result = levelSetLike(*grid, combineTrees(rule, grid->tree(), added, progress));
    setEndlessBox(*result, wider);
    return result;
}

FloatGrid::Ptr levelSetLike(const FloatGrid& grid, FloatTree::Ptr tree)
{
    auto result = FloatGrid::create(std::move(tree));
    result->setName(grid.getName());
    result->setTransform(grid.transform().copy());
    result->setGridClass(openvdb::GRID_LEVEL_SET);
    return result;
}

} // namespace vdbounce
