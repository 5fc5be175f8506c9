// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/grid_csg.h"

#include "vdbounce/base/error.h"
#include "vdbounce/field/openvdb_transform.h"
#include "vdbounce/implicit/grid_csg_complement.h"
#include "vdbounce/implicit/grid_csg_distance.h"
#include "vdbounce/implicit/grid_csg_resample.h"
#include "vdbounce/implicit/grid_csg_trees.h"
#include "vdbounce/io/number_text.h"

#include <Eigen/LU>

#include <cmath>

namespace vdbounce {
namespace {

using openvdb::CoordBBox;
using openvdb::FloatGrid;

// Transforms are the same up to this, voxels: less than the error of the lookup that would be needed otherwise.
constexpr double kSamePlace = 1e-4;

// What a blend must leave of the band, longest sides: the cells that the surface crosses.
constexpr double kLeastBandVx = 2.0;

// For notes: 4 digits.
std::string shortText(double value)
{
    char text[32];
    std::snprintf(text, sizeof(text), "%.4g", value);
    return text;
}

std::string called(const FloatGrid& grid) { return "'" + grid.getName() + "'"; }

double longestSide(const FloatGrid& grid) { return toLinearTransform(grid.transform()).voxelSize().maxCoeff(); }

std::string voxelText(const FloatGrid& grid) { return "voxels of " + shortText(longestSide(grid)); }

// True where the corners of both grids' boxes lie in the same place.
bool sameVoxels(const FloatGrid& a, const FloatGrid& b)
{
    if (a.transform() == b.transform()) return true;
    CoordBBox box = a.evalActiveVoxelBoundingBox();
    box.expand(b.evalActiveVoxelBoundingBox());
    if (box.empty()) return true;
    for (int corner = 0; corner < 8; ++corner) {
        const openvdb::Vec3d index((corner & 1) != 0 ? box.max().x() : box.min().x(),
                                   (corner & 2) != 0 ? box.max().y() : box.min().y(),
                                   (corner & 4) != 0 ? box.max().z() : box.min().z());
        if ((b.worldToIndex(a.indexToWorld(index)) - index).length() > kSamePlace) return false;
    }
    return true;
}

double voxelVolume(const FloatGrid& grid)
{
    return std::abs(toLinearTransform(grid.transform()).indexToWorld().determinant());
}

// `grid` on the voxels of `like`. One without end is resampled by what is not in it.
FloatGrid::ConstPtr onVoxelsOf(const FloatGrid& like, const FloatGrid::ConstPtr& grid, Progress& progress)
{
    const LinearTransform onto = toLinearTransform(like.transform());
    const bool endless = endlessBox(*grid).has_value();
    const FloatGrid::ConstPtr ended = endless ? complementOf(*grid, progress) : grid;
    const CsgBand band = csgBandOf(*ended);
    // Where voxels beyond the band have a part in what is looked up, it is no distance.
    const auto diagonal = float(toLinearTransform(grid->transform()).voxelDiagonal());
    const CsgBand looked{band.exterior + diagonal, band.interior + diagonal};
    const FloatGrid::ConstPtr wide = widened(ended, looked, progress);
    FloatGrid::Ptr result = resampled(toLevelSetGrid(wide, called(*grid)), onto, band, progress);
    return endless ? complementOf(*result, progress) : result;
}

struct Operands {
    FloatGrid::ConstPtr a;
    FloatGrid::ConstPtr b;
};

// Both on the same voxels.
void align(Operands& of, const GridCsgOptions& options, std::vector<std::string>& notes, Progress& progress)
{
    if (sameVoxels(*of.a, *of.b)) return;
    const bool ontoA = options.voxels == CsgVoxels::First || voxelVolume(*of.a) <= voxelVolume(*of.b);
    const FloatGrid::ConstPtr& kept = ontoA ? of.a : of.b;
    FloatGrid::ConstPtr& moved = ontoA ? of.b : of.a;
    notes.push_back("resampled: " + called(*moved) + " (" + voxelText(*moved) + ") onto the voxels of " +
                    called(*kept) + " (" + voxelText(*kept) + ")");
    moved = onVoxelsOf(*kept, moved, progress);
}

// Whether the result has no end, given which operands have none.
bool isEndless(CsgOperation operation, bool a, bool b)
{
    if (operation == CsgOperation::Union) return a || b;
    return operation == CsgOperation::Intersection ? a && b : a && !b;
}

// Grids without end reach around all that there is of the other; returns the result's box where it has no end.
std::optional<CoordBBox> reach(Operands& of, CsgOperation operation, const Progress& progress)
{
    const auto boxA = endlessBox(*of.a);
    const auto boxB = endlessBox(*of.b);
    if (!boxA && !boxB) return std::nullopt;
    CoordBBox all = boxA ? *boxA : paddedBox(*of.a);
    all.expand(boxB ? *boxB : paddedBox(*of.b));
    of.a = reachingTo(of.a, all, progress);
    of.b = reachingTo(of.b, all, progress);
    if (!isEndless(operation, boxA.has_value(), boxB.has_value())) return std::nullopt;
    return all;
}

// Both with so much of a band that a blend leaves as much as there is without.
void widenForBlend(Operands& of, CsgOperation operation, float blend, std::vector<std::string>& notes,
                   Progress& progress)
{
    if (blend == 0.0f) return;
    const CsgBand kept = CsgRule(operation, csgBandOf(*of.a), csgBandOf(*of.b), 0.0f).band();
    const float lost = kBandLostToBlend * blend;
    const CsgBand needed = operation == CsgOperation::Union ? CsgBand{kept.exterior + lost, kept.interior}
                                                            : CsgBand{kept.exterior, kept.interior + lost};
    const bool turned = operation == CsgOperation::Subtraction;
    const FloatGrid::ConstPtr a = widened(of.a, needed, progress);
    const FloatGrid::ConstPtr b = widened(of.b, turned ? CsgBand{needed.interior, needed.exterior} : needed, progress);
    if (a != of.a || b != of.b) notes.push_back("widened: the bands, by redistancing, for the blend");
    of = {a, b};
}

void requireBand(const CsgRule& rule, double voxel)
{
    const double left = std::min(double(rule.high), -double(rule.low));
    if (rule.blend == 0.0f || left >= kLeastBandVx * voxel) return;
    const double needed = double(kBandLostToBlend) * double(rule.blend) / voxel + kLeastBandVx;
    throw UsageError("--blend",
                     shortText(double(rule.blend)) + " needs bands of " + shortText(std::ceil(needed)) + "vx, " +
                         shortText(kLeastBandVx) + "vx of which it leaves",
                     "widen the grids with 'vdbounce redistance --band', or blend less");
}

std::string bandText(const CsgBand& band, double voxel)
{
    const std::string inside = std::isinf(band.interior) ? "all" : shortText(double(band.interior) / voxel) + "vx";
    return shortText(double(band.exterior) / voxel) + "vx outside, " + inside + " inside";
}

void noteBands(CsgOperation operation, const CsgBand& a, const CsgBand& b, double voxel,
               std::vector<std::string>& notes)
{
    if (a.exterior == b.exterior && (a.interior == b.interior || std::isinf(a.interior + b.interior))) return;
    notes.push_back("bands of " + bandText(a, voxel) + " and " + bandText(b, voxel) + " make one of " +
                    bandText(CsgRule(operation, a, b, 0.0f).band(), voxel));
}

bool holdsNothing(const FloatGrid& grid) { return grid.tree().root().empty(); }

bool hasInside(const FloatGrid& grid)
{
    // Leaves first: at most results the first few settle it, while tiles are looked for among all entries of a node.
    if (hasVoxelInside(grid)) return true;
    auto tile = grid.tree().cbeginValueAll();
    tile.setMaxDepth(openvdb::FloatTree::ValueAllCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
        if (*tile < 0.0f) return true;
    }
    return false;
}

void noteWhatIsLeft(const FloatGrid& grid, bool redistance, std::vector<std::string>& notes)
{
    if (!holdsNothing(grid) && hasInside(grid)) return;
    const bool empty = holdsNothing(grid) || redistance; // which leaves nothing of sheets
    notes.push_back(empty ? "the result is empty"
                          : "the result has no inside, only phi of 0 and more where faces lie in each other or close "
                            "together");
}

LevelSetGrid finished(FloatGrid::Ptr grid, const GridCsgOptions& options, const std::string& name, Progress& progress)
{
    const std::string called = options.name.empty() ? name : options.name;
    grid->setName(called);
    if (options.redistance) {
        grid = redistanced(*grid, csgBandOf(*grid), progress);
        grid->setName(called);
    }
    return toLevelSetGrid(grid, called);
}

} // namespace

GridCsg csg(CsgOperation operation, const LevelSetGrid& first, const LevelSetGrid& second,
            const GridCsgOptions& options, Progress& progress)
{
    if (operation == CsgOperation::Complement)
        throw UsageError("csg", "a complement is of one grid", "call complement()");
    if (!(options.blend.value >= 0.0) || !std::isfinite(options.blend.value))
        throw UsageError("--blend", numberText(options.blend.value) + " is no distance to round edges by",
                         "give a length of 0 or more");
    GridCsg result;
    Operands operands{first.holder().grid, second.holder().grid};
    align(operands, options, result.notes, progress);
    const double voxel = longestSide(*operands.a);
    const auto blend = float(options.blend.world(voxel));
    noteBands(operation, csgBandOf(*operands.a), csgBandOf(*operands.b), voxel, result.notes);
    widenForBlend(operands, operation, blend, result.notes, progress);
    const std::optional<CoordBBox> ends = reach(operands, operation, progress);
    const CsgRule rule(operation, csgBandOf(*operands.a), csgBandOf(*operands.b), blend);
    requireBand(rule, voxel);
    auto grid = levelSetLike(*operands.a, combineTrees(rule, operands.a->tree(), operands.b->tree(), progress));
    setEndlessBox(*grid, ends);
    noteWhatIsLeft(*grid, options.redistance, result.notes);
    result.grid = finished(std::move(grid), options, toOpenVdb(first).getName(), progress);
    return result;
}

GridCsg complement(const LevelSetGrid& a, const GridCsgOptions& options, Progress& progress)
{
    const FloatGrid& grid = toOpenVdb(a);
    if (grid.activeVoxelCount() == 0)
        throw InputError("grid " + called(grid), "holds no surface, and its complement would have none",
                         "name a level set with a surface");
    GridCsg result;
    result.grid = finished(complementOf(grid, progress), options, grid.getName(), progress);
    return result;
}

} // namespace vdbounce
