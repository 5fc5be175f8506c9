// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/surface_measure.h"

#include "vdbounce/base/disjoint_sets.h"
#include "vdbounce/base/error.h"
#include "vdbounce/base/parallel.h"
#include "vdbounce/field/surface_patches.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

constexpr std::size_t kBlocksPerTask = 16;

std::vector<SurfacePatches> cutBlocks(const DistanceField& field, const Mat3d& areaToWorld)
{
    const LeafBlocks& blocks = field.blocks();
    std::vector<SurfacePatches> cut(blocks.blockCount());
    if (field.empty()) return cut;
    forEachIndex(cut.size(), kBlocksPerTask, [&](std::size_t b) {
        cut[b] = cutSurface({blocks.values().floats().data() + b * BlockLayout::kSize, blocks.origins()[b],
                             field.indexBox().min.cast<int>(), field.indexBox().max.cast<int>()},
                            areaToWorld);
    });
    return cut;
}

// Joins the patches of neighbouring blocks; `first` is the number of each block's first patch among all.
DisjointSets joinBlocks(const LeafBlocks& blocks, const std::vector<SurfacePatches>& cut,
                        const std::vector<std::uint32_t>& first)
{
    DisjointSets sets(first.back());
    for (std::size_t b = 0; b < cut.size(); ++b) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto& here = cut[b].high[axis];
            if (here.empty()) continue;
            const LeafBlocks::Entry next =
                blocks.entryAt(blocks.origins()[b] + BlockLayout::kLeafSide * Vec3i::Unit(int(axis)));
            if (!next.isBlock()) continue;
            const auto& there = cut[next.block()].low[axis];
            for (std::size_t i = 0; i < std::min(here.size(), there.size()); ++i)
                sets.join(first[b] + here[i], first[next.block()] + there[i]);
        }
    }
    return sets;
}

// A piece while its patches are added up, in index space around the block of its first one.
struct Sum {
    double area = 0.0;
    double volume = 0.0;
    bool open = false;
    Vec3i origin = Vec3i::Zero();
    Vec3d place = Vec3d::Zero();

    void add(const SurfacePatches::Patch& patch, const Vec3i& patchOrigin)
    {
        const Vec3d offset = (patchOrigin - origin).cast<double>();
        area += patch.area;
        volume += patch.volume + offset.dot(patch.vectorArea) / 3.0;
        open = open || patch.open;
    }
};

std::vector<Sum> addUp(const LeafBlocks& blocks, const std::vector<SurfacePatches>& cut,
                       const std::vector<std::uint32_t>& first)
{
    DisjointSets sets = joinBlocks(blocks, cut, first);
    std::vector<Sum> sums;
    std::vector<std::uint32_t> pieceOfPatch(first.back());
    for (std::size_t b = 0; b < cut.size(); ++b) {
        for (std::size_t i = 0; i < cut[b].patches.size(); ++i) {
            const SurfacePatches::Patch& patch = cut[b].patches[i];
            const std::uint32_t number = first[b] + std::uint32_t(i);
            const std::uint32_t name = sets.find(number);
            if (name == number) {
                pieceOfPatch[number] = std::uint32_t(sums.size());
                sums.emplace_back();
                sums.back().origin = blocks.origins()[b];
                sums.back().place = patch.place;
            }
            sums[pieceOfPatch[name]].add(patch, blocks.origins()[b]);
        }
    }
    return sums;
}

void add(const Sum& sum, const LinearTransform& transform, double voxelVolume, SurfaceMeasure& measure)
{
    const double volume = sum.open ? 0.0 : sum.volume * voxelVolume;
    measure.pieces.push_back({sum.area, volume, !sum.open, transform.toWorld(sum.origin.cast<double>() + sum.place)});
    measure.area += sum.area;
    measure.volume += volume;
    ++(sum.open ? measure.open : volume < 0.0 ? measure.cavities : measure.solids);
}

} // namespace

SurfaceMeasure measureSurface(const DistanceField& field)
{
    if (field.options().storage != Storage::Float)
        throw UsageError("measureSurface", "was given a field that is not stored as floats", "use Storage::Float");
    const LinearTransform& transform = field.transform();
    const double voxelVolume = std::abs(transform.indexToWorld().determinant());
    const std::vector<SurfacePatches> cut = cutBlocks(field, voxelVolume * transform.gradientToWorld());
    std::vector<std::uint32_t> first(cut.size() + 1);
    for (std::size_t b = 0; b < cut.size(); ++b) first[b + 1] = first[b] + std::uint32_t(cut[b].patches.size());
    SurfaceMeasure measure;
    for (const Sum& sum : addUp(field.blocks(), cut, first)) add(sum, transform, voxelVolume, measure);
    return measure;
}

} // namespace vdbounce
