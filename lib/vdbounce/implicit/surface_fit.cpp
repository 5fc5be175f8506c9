// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/surface_fit.h"

#include "vdbounce/base/parallel.h"

#include <algorithm>

namespace vdbounce {
namespace {

constexpr std::size_t kLeavesPerTask = 16;
constexpr std::size_t kCells = 512; // of a leaf

std::size_t offsetOf(const Vec3i& cell)
{
    return std::size_t((cell.x() & 7) * 64 + (cell.y() & 7) * 8 + (cell.z() & 7));
}

} // namespace

std::int32_t FittedSurface::patchOf(const Vec3i& cell, std::size_t& leaf) const
{
    const Vec3i origin(cell.x() & ~7, cell.y() & ~7, cell.z() & ~7);
    if (leaf >= leaves.size() || leaves[leaf].origin != origin) {
        const auto found = std::lower_bound(leaves.begin(), leaves.end(), origin, [](const Leaf& a, const Vec3i& b) {
            return std::lexicographical_compare(a.origin.data(), a.origin.data() + 3, b.data(), b.data() + 3);
        });
        if (found == leaves.end() || found->origin != origin) return -1;
        leaf = std::size_t(found - leaves.begin());
    }
    return ofCell[leaf * kCells + offsetOf(cell)];
}

FittedSurface fitSurface(const ImplicitSamples& samples, const VoxelMetric& metric, Progress& progress)
{
    const std::vector<Vec3i> origins = samples.candidateLeaves();
    std::vector<LeafPatches> found(origins.size());
    forEachBlock(origins.size(), kLeavesPerTask, [&](std::size_t, IndexRange range) {
        throwIfStopped(progress);
        SampleBlock block;
        for (std::size_t i = range.begin; i < range.end; ++i) {
            samples.load(origins[i], block);
            fitPatches(block, origins[i], metric, found[i]);
        }
    });
    FittedSurface surface;
    std::vector<std::size_t> firstTriangle;
    std::vector<std::size_t> source;
    std::size_t patches = 0;
    std::size_t triangles = 0;
    for (std::size_t i = 0; i < origins.size(); ++i) {
        if (found[i].patches.empty()) continue;
        surface.leaves.push_back({origins[i], patches, patches + found[i].patches.size()});
        source.push_back(i);
        firstTriangle.push_back(triangles);
        patches += found[i].patches.size();
        triangles += found[i].triangles.size();
    }
    surface.patches.resize(patches);
    surface.triangles.resize(triangles);
    surface.ofCell.assign(surface.leaves.size() * kCells, -1);
    forEachIndex(source.size(), kLeavesPerTask, [&](std::size_t i) {
        LeafPatches& from = found[source[i]];
        auto number = std::int32_t(surface.leaves[i].begin);
        for (SurfacePatch& patch : from.patches) {
            patch.firstTriangle += std::uint32_t(firstTriangle[i]);
            surface.ofCell[i * kCells + offsetOf(Vec3i(patch.cell[0], patch.cell[1], patch.cell[2]))] = number++;
        }
        std::copy(from.patches.begin(), from.patches.end(),
                  surface.patches.begin() + std::ptrdiff_t(surface.leaves[i].begin));
        std::copy(from.triangles.begin(), from.triangles.end(),
                  surface.triangles.begin() + std::ptrdiff_t(firstTriangle[i]));
        from = LeafPatches();
    });
    return surface;
}

} // namespace vdbounce
