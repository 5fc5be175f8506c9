// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/thin_features.h"

#include "vdbounce/base/parallel.h"

#include <cmath>

namespace vdbounce {
namespace {

constexpr std::size_t kBlocksPerTask = 64;

// Of a wall's middle, wherever its voxels lie, it is 0.5 at most; a right angle has sqrt(1/2).
constexpr double kCancelled = 0.55;

using Kind = ThinFeatures::Kind;

void add(Kind& sum, const Kind& part)
{
    if (part.voxels > 0 && (sum.voxels == 0 || part.thinnest < sum.thinnest)) {
        sum.thinnest = part.thinnest;
        sum.place = part.place;
    }
    sum.voxels += part.voxels;
}

struct Features : ThinFeatures {
    Features& operator+=(const Features& other)
    {
        add(walls, other.walls);
        add(gaps, other.gaps);
        return *this;
    }
};

void lookAt(const float* v, const Vec3i& voxel, const DistanceField& field, Features& features)
{
    const double side = field.voxelSize();
    if (!(std::abs(double(*v)) < side)) return;
    const int strides[] = {BlockLayout::kStrideX, BlockLayout::kStrideY, 1};
    Vec3d gradient;
    double bend = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double before = double(v[-strides[axis]]);
        const double after = double(v[strides[axis]]);
        gradient[axis] = 0.5 * (after - before);
        bend += before + after - 2.0 * double(*v);
    }
    if (!(field.transform().gradientToWorld(gradient).norm() < kCancelled)) return;
    // Voxels beside the box know nothing.
    if (!field.indexBox().contains(voxel.cast<double>() - Vec3d::Ones()) ||
        !field.indexBox().contains(voxel.cast<double>() + Vec3d::Ones()))
        return;
    // Outside of a wall so thin that no voxel is in it phi has a least value, too: nothing of it is left.
    const bool wall = bend > 0.0;
    const double thickness = wall ? std::max(0.0, -2.0 * double(*v)) : std::max(0.0, 2.0 * double(*v));
    add(wall ? features.walls : features.gaps, {1, thickness, field.transform().toWorld(voxel.cast<double>())});
}

} // namespace

ThinFeatures thinFeatures(const DistanceField& field)
{
    const LeafBlocks& blocks = field.blocks();
    return reduceBlocks(blocks.blockCount(), kBlocksPerTask, Features{}, [&](IndexRange range) {
        Features part;
        float block[BlockLayout::kSize];
        for (std::size_t b = range.begin; b < range.end; ++b) {
            blocks.values().decode(b, block);
            for (int i = 0; i < BlockLayout::kLeafSide * BlockLayout::kLeafSide * BlockLayout::kLeafSide; ++i) {
                const Vec3i at(i >> 6, i >> 3 & 7, i & 7);
                const int place =
                    (at.x() + 1) * BlockLayout::kStrideX + (at.y() + 1) * BlockLayout::kStrideY + at.z() + 1;
                lookAt(block + place, blocks.origins()[b] + at, field, part);
            }
        }
        return part;
    });
}

} // namespace vdbounce
