// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/foot_points.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/implicit/foot_exchange.h"
#include "vdbounce/implicit/foot_refinement.h"
#include "vdbounce/implicit/leaf_limit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace vdbounce {
namespace {

constexpr std::size_t kLeavesPerTask = 16;

// Patches are as wide as a cell, so that the point of the right one is at most this much farther than the closest
// point of the surface; units of the longest side.
constexpr float kPatchReach = 1.0f;

// From this band on, voxels, the eighths of a leaf reach nearly the same leaves as all of it.
constexpr double kWideVx = 16.0;

bool comesBefore(const Vec3i& a, const Vec3i& b)
{
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

void sortOnce(std::vector<Vec3i>& origins)
{
    std::sort(origins.begin(), origins.end(), comesBefore);
    origins.erase(std::unique(origins.begin(), origins.end()), origins.end());
}

Box joined(Box a, const Box& b)
{
    if (!b.empty()) a.add(b);
    return a;
}

// Appends the origins of the leaves with a voxel within `voxels` of a box (index space).
void appendLeaves(const Box& box, const Vec3d& voxels, std::uint64_t maxLeaves, std::vector<Vec3i>& origins)
{
    const Vec3d low = ((box.min - voxels).array().ceil() / 8.0).floor();
    const Vec3d high = ((box.max + voxels).array().floor() / 8.0).floor();
    requireLeaves(std::uint64_t((high - low + Vec3d::Ones()).prod()), maxLeaves);
    for (int x = int(low.x()); x <= int(high.x()); ++x) {
        for (int y = int(low.y()); y <= int(high.y()); ++y) {
            for (int z = int(low.z()); z <= int(high.z()); ++z) origins.push_back(8 * Vec3i(x, y, z));
        }
    }
}

// The eighths of a leaf that hold patches: the box around their points.
std::array<Box, 8> eighthsOf(const FittedSurface& surface, const FittedSurface::Leaf& leaf)
{
    std::array<Box, 8> boxes;
    for (std::size_t p = leaf.begin; p < leaf.end; ++p) {
        const SurfacePatch& patch = surface.patches[p];
        const Vec3d cell(patch.cell[0], patch.cell[1], patch.cell[2]);
        const Vec3d at = cell + Vec3d(0.5 + patch.at[0], 0.5 + patch.at[1], 0.5 + patch.at[2]);
        const int eighth = (patch.cell[0] >> 2 & 1) * 4 + (patch.cell[1] >> 2 & 1) * 2 + (patch.cell[2] >> 2 & 1);
        boxes[std::size_t(eighth)].add(at);
    }
    return boxes;
}

// Origins of all leaves with a voxel within `reach` of some patch, in lexicographic order.
std::vector<Vec3i> leavesAround(const FittedSurface& surface, const VoxelMetric& metric, float reach,
                                std::uint64_t maxLeaves)
{
    // As many voxels along each axis as a way of that length can take.
    const Vec3d voxels = double(reach) * metric.toIndex.rowwise().norm();
    const bool wide = voxels.minCoeff() > kWideVx;
    std::vector<std::vector<Vec3i>> around(blockCount(surface.leaves.size(), kLeavesPerTask));
    forEachBlock(surface.leaves.size(), kLeavesPerTask, [&](std::size_t block, IndexRange range) {
        for (std::size_t i = range.begin; i < range.end; ++i) {
            std::array<Box, 8> boxes = eighthsOf(surface, surface.leaves[i]);
            if (wide) boxes = {std::accumulate(boxes.begin() + 1, boxes.end(), boxes[0], joined)};
            for (const Box& box : boxes) {
                if (!box.empty()) appendLeaves(box, voxels, maxLeaves, around[block]);
            }
        }
        sortOnce(around[block]); // leaves beside each other have most of them in common
    });
    std::vector<Vec3i> all;
    for (auto& some : around) {
        all.insert(all.end(), some.begin(), some.end());
        std::vector<Vec3i>().swap(some);
    }
    sortOnce(all);
    requireLeaves(all.size(), maxLeaves);
    return all;
}

// Each voxel at a corner of a patch's cell takes the nearest of its patches' points.
void seed(const FittedSurface& surface, const FittedSurface::Leaf& patches, const VoxelMetric& metric, FootLeaf& leaf)
{
    for (std::size_t p = patches.begin; p < patches.end; ++p) {
        const SurfacePatch& patch = surface.patches[p];
        for (int corner = 0; corner < 8; ++corner) {
            const int offset[3] = {corner >> 2, corner >> 1 & 1, corner & 1};
            int at[3];
            float way[3];
            for (int a = 0; a < 3; ++a) {
                at[a] = patch.cell[a] - leaf.origin[a] + offset[a];
                way[a] = patch.at[a] + 0.5f - float(offset[a]);
            }
            if (at[0] > 7 || at[1] > 7 || at[2] > 7) continue; // the leaf beside gets it through the face
            const int v = 64 * at[0] + 8 * at[1] + at[2];
            const float squared = metric.squared(way);
            if (!(squared < leaf.squared[v])) continue;
            for (int a = 0; a < 3; ++a) leaf.way[a][v] = way[a];
            leaf.squared[v] = squared;
            leaf.patch[v] = std::int32_t(p);
        }
    }
}

FootLeaves makeLeaves(const FittedSurface& surface, const VoxelMetric& metric, float reach, std::uint64_t maxLeaves)
{
    const std::vector<Vec3i> origins = leavesAround(surface, metric, reach, maxLeaves);
    FootLeaves leaves(origins.size());
    forEachIndex(origins.size(), kLeavesPerTask, [&](std::size_t i) {
        auto leaf = std::make_unique<FootLeaf>();
        leaf->origin = origins[i];
        const float limit = reach * reach;
        std::fill(std::begin(leaf->squared), std::end(leaf->squared), limit);
        std::fill(std::begin(leaf->patch), std::end(leaf->patch), FootLeaf::kNone);
        for (auto& way : leaf->way) std::fill(std::begin(way), std::end(way), 0.0f);
        for (int face = 0; face < 6; ++face) {
            Vec3i beside = origins[i];
            beside[face / 2] += face % 2 == 0 ? -8 : 8;
            const auto found = std::lower_bound(origins.begin(), origins.end(), beside, comesBefore);
            const bool there = found != origins.end() && *found == beside;
            leaf->neighbours[std::size_t(face)] = there ? std::int32_t(found - origins.begin()) : -1;
        }
        const auto own =
            std::lower_bound(surface.leaves.begin(), surface.leaves.end(), origins[i],
                             [](const FittedSurface::Leaf& a, const Vec3i& b) { return comesBefore(a.origin, b); });
        if (own != surface.leaves.end() && own->origin == origins[i]) seed(surface, *own, metric, *leaf);
        leaves[i] = std::move(leaf);
    });
    return leaves;
}

// Hands points on until nothing changes, leaf by leaf in two colours. Leaves beside each other's faces have different
// ones, so that no leaf is read while it changes. `visit(i, first)` tells whether leaf i changed.
template <class Visit> void handOn(FootLeaves& leaves, Progress& progress, const Visit& visit)
{
    std::vector<std::size_t> ofColour[2];
    for (std::size_t i = 0; i < leaves.size(); ++i)
        ofColour[(leaves[i]->origin.x() + leaves[i]->origin.y() + leaves[i]->origin.z()) >> 3 & 1].push_back(i);
    std::vector<int> changedAt(leaves.size(), 0);
    std::vector<int> visitedAt(leaves.size(), -1);
    for (int round = 0, quiet = 0; quiet < 2; ++round) {
        const std::vector<std::size_t>& mine = ofColour[round & 1];
        std::vector<std::uint8_t> changed(blockCount(mine.size(), kLeavesPerTask), 0);
        forEachBlock(mine.size(), kLeavesPerTask, [&](std::size_t block, IndexRange range) {
            throwIfStopped(progress);
            for (std::size_t k = range.begin; k < range.end; ++k) {
                const std::size_t i = mine[k];
                const bool first = visitedAt[i] < 0;
                bool due = first;
                for (const std::int32_t n : leaves[i]->neighbours)
                    due = due || (n >= 0 && changedAt[std::size_t(n)] > visitedAt[i]);
                if (!due) continue;
                visitedAt[i] = round;
                if (!visit(i, first)) continue;
                changedAt[i] = round + 1;
                changed[block] = 1;
            }
        });
        const bool any = std::find(changed.begin(), changed.end(), 1) != changed.end();
        quiet = any || round == 0 ? 0 : quiet + 1;
    }
}

} // namespace

FootLeaves findFeet(const FittedSurface& surface, const VoxelMetric& metric, float reach, std::uint64_t maxLeaves,
                    Progress& progress)
{
    FootLeaves leaves = makeLeaves(surface, metric, reach + kPatchReach, maxLeaves);
    handOn(leaves, progress, [&](std::size_t i, bool fresh) {
        VoxelSet changed;
        return exchangeFeet(leaves, i, metric, Margin::ofPoints(), fresh, changed);
    });
    VoxelSet all;
    all.fill(~std::uint64_t(0));
    forEachIndex(leaves.size(), kLeavesPerTask, [&](std::size_t i) {
        refineFeet(surface, metric, all, *leaves[i]);
        searchFeet(surface, metric, Unsure::BeyondPatch, *leaves[i]);
    });
    handOn(leaves, progress, [&](std::size_t i, bool fresh) {
        VoxelSet changed;
        if (!exchangeFeet(leaves, i, metric, Margin::ofRefined(), fresh, changed)) return false;
        refineFeet(surface, metric, changed, *leaves[i]);
        return true;
    });
    forEachIndex(leaves.size(), kLeavesPerTask,
                 [&](std::size_t i) { searchFeet(surface, metric, Unsure::All, *leaves[i]); });
    return leaves;
}

} // namespace vdbounce
