// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/distance_assembly.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/field/grid_assembly.h"
#include "vdbounce/implicit/foot_refinement.h"

#include <openvdb/tools/Prune.h>

#include <cmath>

namespace vdbounce {
namespace {

using Tree = openvdb::FloatTree;
using Leaf = Tree::LeafNodeType;

constexpr std::uint64_t kAll = ~std::uint64_t(0);

openvdb::Coord toCoord(const Vec3i& v) { return openvdb::Coord(v.x(), v.y(), v.z()); }

bool bitOf(const std::array<std::uint64_t, 8>& words, int v)
{
    return (words[std::size_t(v >> 6)] >> (v & 63) & 1) != 0;
}

// Where the side is not known, nor a foot, that of the voxels before in any direction.
void spread(ImplicitSamples::Sides& sides)
{
    for (int round = 0; round < 3; ++round) {
        for (int axis = 0; axis < 3; ++axis) {
            const int stride = 64 >> (3 * axis);
            for (int step = -1; step <= 1; step += 2) {
                for (int i = 0; i < FootLeaf::kVoxels; ++i) {
                    const int v = step > 0 ? i : FootLeaf::kVoxels - 1 - i;
                    const int place = (v / stride & 7) - step;
                    if (bitOf(sides.known, v) || place < 0 || place > 7 || !bitOf(sides.known, v - step * stride))
                        continue;
                    sides.known[std::size_t(v >> 6)] |= std::uint64_t(1) << (v & 63);
                    const auto inside = std::uint64_t(bitOf(sides.inside, v - step * stride) ? 1 : 0);
                    sides.inside[std::size_t(v >> 6)] =
                        (sides.inside[std::size_t(v >> 6)] & ~(std::uint64_t(1) << (v & 63))) | inside << (v & 63);
                }
            }
        }
    }
}

// Beyond where a level set was cut off its background says outside, whatever the surface says: no distance is known.
void dropContradictions(const FittedSurface& surface, const ImplicitSamples::Sides& sides, FootLeaf& leaf)
{
    for (int v = 0; v < FootLeaf::kVoxels; ++v) {
        if (leaf.patch[v] == FootLeaf::kNone || surface.patches[std::size_t(leaf.patch[v])].rim == 0) continue;
        if (outsideOfPatch(surface, leaf, v) == bitOf(sides.inside, v)) leaf.patch[v] = FootLeaf::kNone;
    }
}

ImplicitSamples::Sides sidesOf(FootLeaf& leaf, const FittedSurface& surface, const ImplicitSamples& samples)
{
    ImplicitSamples::Sides sides = samples.sides(leaf.origin);
    if (samples.sideKnownEverywhere()) {
        dropContradictions(surface, sides, leaf);
        return sides;
    }
    for (int v = 0; v < FootLeaf::kVoxels; ++v) {
        if (bitOf(sides.known, v) || leaf.patch[v] == FootLeaf::kNone) continue;
        const std::uint64_t bit = std::uint64_t(1) << (v & 63);
        sides.known[std::size_t(v >> 6)] |= bit;
        if (outsideOfPatch(surface, leaf, v)) {
            sides.inside[std::size_t(v >> 6)] &= ~bit;
        } else {
            sides.inside[std::size_t(v >> 6)] |= bit;
        }
    }
    spread(sides);
    return sides;
}

class Assembly {
public:
    Assembly(const ImplicitSamples& samples, const VoxelMetric& metric, const DistanceBand& band)
        : samples_(samples), metric_(metric), band_(band)
    {
    }

    std::unique_ptr<Leaf> leafOf(const FootLeaf& feet, const ImplicitSamples::Sides& sides) const
    {
        auto target = std::make_unique<Leaf>(toCoord(feet.origin), band_.exterior);
        float* values = target->buffer().data();
        Leaf::NodeMaskType active;
        for (int v = 0; v < FootLeaf::kVoxels; ++v) {
            const bool inside = bitOf(sides.inside, v);
            const float width = inside ? band_.interior : band_.exterior;
            const float distance =
                feet.patch[v] == FootLeaf::kNone ? width : float(metric_.unit * std::sqrt(double(feet.squared[v])));
            const bool within = distance < width;
            const float magnitude = within ? distance : width;
            values[v] = inside ? -magnitude : magnitude;
            if (within) active.setOn(openvdb::Index(v));
        }
        target->setValueMask(active);
        return target;
    }

    // Tiles of what the implicit grid says is inside.
    void addKnownInside(openvdb::FloatGrid& grid) const
    {
        const Tree& source = samples_.grid().tree();
        auto tile = source.cbeginValueAll();
        tile.setMaxDepth(Tree::ValueAllCIter::LEAF_DEPTH - 1);
        for (; tile; ++tile) {
            if (!(samples_.toF(*tile) < 0.0f)) continue;
            if (!samples_.sideKnownEverywhere() && !tile.isValueOn()) continue;
            grid.tree().addTile(tile.getLevel(), tile.getCoord(), -band_.interior, false);
        }
        for (auto leaf = source.cbeginLeaf(); leaf; ++leaf) {
            const openvdb::Coord origin = leaf->origin();
            const ImplicitSamples::Sides sides = samples_.sides(Vec3i(origin.x(), origin.y(), origin.z()));
            bool inside = true;
            for (std::size_t x = 0; x < 8; ++x) inside = inside && (sides.inside[x] & sides.known[x]) == kAll;
            if (inside) grid.tree().addTile(1, origin, -band_.interior, false);
        }
    }

private:
    const ImplicitSamples& samples_;
    const VoxelMetric& metric_;
    const DistanceBand& band_;
};

// Blocks between two leaves of a column along z which face each other with their insides.
void fillGaps(const FootLeaves& leaves, const std::vector<ImplicitSamples::Sides>& sides, float interior,
              openvdb::FloatGrid& grid)
{
    constexpr std::uint64_t kFirstZ = 0x0101010101010101u;
    for (std::size_t i = 0; i + 1 < leaves.size(); ++i) {
        const Vec3i from = leaves[i]->origin;
        const Vec3i to = leaves[i + 1]->origin;
        if (from.x() != to.x() || from.y() != to.y() || to.z() == from.z() + 8) continue;
        bool inside = true;
        for (std::size_t x = 0; x < 8; ++x) {
            inside = inside && (sides[i].inside[x] >> 7 & kFirstZ) == kFirstZ &&
                     (sides[i + 1].inside[x] & kFirstZ) == kFirstZ;
        }
        for (int z = from.z() + 8; inside && z < to.z(); z += 8)
            grid.tree().addTile(1, openvdb::Coord(from.x(), from.y(), z), -interior, false);
    }
}

} // namespace

LevelSetGrid assembleDistances(FootLeaves leaves, const FittedSurface& surface, const ImplicitSamples& samples,
                               const VoxelMetric& metric, const DistanceBand& band, const std::string& name)
{
    auto grid = openvdb::FloatGrid::create(band.exterior);
    grid->setName(name);
    grid->setTransform(samples.grid().transform().copy());
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    std::vector<ImplicitSamples::Sides> sides(leaves.size());
    forEachIndex(leaves.size(), kLeavesPerTask,
                 [&](std::size_t i) { sides[i] = sidesOf(*leaves[i], surface, samples); });
    const Assembly assembly(samples, metric, band);
    assembly.addKnownInside(*grid);
    if (!samples.sideKnownEverywhere()) fillGaps(leaves, sides, band.interior, *grid);
    addLeaves(*grid, leaves.size(), [&](std::size_t i) {
        auto target = assembly.leafOf(*leaves[i], sides[i]);
        leaves[i].reset();
        return target;
    });
    openvdb::tools::prune(grid->tree());
    return toLevelSetGrid(grid, name.empty() ? "redistanced grid" : name);
}

} // namespace vdbounce
