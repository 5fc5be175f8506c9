// SPDX-License-Identifier: Apache-2.0
#include "bench/precomputed_gradients.h"

#include "bench/precomputed_lookup.h"

#include "vdbounce/base/parallel.h"

#include <algorithm>

namespace vdbounce::bench {
namespace {

constexpr std::size_t kLeavesPerTask = 32;
constexpr std::size_t kPointsPerTask = 4096; // as samplePoints()

// Of one leaf, from its values in a BlockLayout.
void precompute(const float* values, const LinearTransform& transform, float* voxels)
{
    constexpr int kSide = PrecomputedLayout::kSide;
    constexpr int kStrides[3] = {BlockLayout::kStrideX, BlockLayout::kStrideY, 1};
    for (int i = 0; i < kSide * kSide * kSide; ++i) {
        const int place = i / (kSide * kSide) * kStrides[0] + i / kSide % kSide * kStrides[1] + i % kSide;
        const float* own = values + place + BlockLayout::kDiagonal;
        Vec3d gradient;
        for (int axis = 0; axis < 3; ++axis)
            gradient[axis] = 0.5 * (double(own[kStrides[axis]]) - double(own[-kStrides[axis]]));
        const Vec3d world = transform.gradientToWorld(gradient);
        *voxels++ = *own;
        for (int axis = 0; axis < 3; ++axis) *voxels++ = float(world[axis]);
    }
}

PointSample sampleOne(const DistanceField& field, const Vec3d& point)
{
    const FieldSample sample = field.sample(point);
    return {float(sample.phi), {float(sample.gradient.x()), float(sample.gradient.y()), float(sample.gradient.z())}};
}

} // namespace

PrecomputedGradients::PrecomputedGradients(const DistanceField& field) : field_(field)
{
    const std::size_t blocks = field.blocks().blockCount();
    voxels_.resize(blocks * PrecomputedLayout::kSize);
    forEachIndex(blocks, kLeavesPerTask, [&](std::size_t i) {
        precompute(field.blocks().values().floats().data() + i * BlockLayout::kSize, field.transform(),
                   voxels_.data() + i * PrecomputedLayout::kSize);
    });
}

std::size_t PrecomputedGradients::memoryBytes() const
{
    return field_.memoryBytes() - field_.blocks().values().memoryBytes() + voxels_.size() * sizeof(float);
}

void PrecomputedGradients::sample(const Vec3d* points, std::size_t count, PointSample* samples) const
{
    if (field_.empty() || field_.blocks().blockCount() == 0 || field_.blocks().directory().nodes == nullptr) {
        forEachIndex(count, kPointsPerTask, [&](std::size_t i) { samples[i] = sampleOne(field_, points[i]); });
        return;
    }
    const VectorField vectorField(field_);
    forEachBlock(count, kPointsPerTask, [&](std::size_t, IndexRange range) {
        for (std::size_t begin = range.begin; begin < range.end; begin += kPointsPerChunk) {
            const int size = int(std::min(range.end - begin, std::size_t(kPointsPerChunk)));
            sampleChunk(vectorField, points + begin, size, samples + begin);
        }
    });
}

// Points that are not in blocks are interpolated in the first block for nothing, and then answered by the field.
void PrecomputedGradients::sampleChunk(const VectorField& vectorField, const Vec3d* points, int count,
                                       PointSample* samples) const
{
    PointChunk chunk;
    if (locatePoints(vectorField, points, count, chunk) && count == kPointsPerChunk) {
        interpolatePrecomputed(voxels_.data(), chunk, count, samples);
        return;
    }
    std::uint64_t elsewhere = chunk.outside;
    for (int i = 0; i < count; ++i) {
        if (chunk.entry[i] >= 0) continue;
        elsewhere |= std::uint64_t(1) << i;
        chunk.entry[i] = 0;
    }
    PointSample results[kPointsPerChunk];
    interpolatePrecomputed(voxels_.data(), chunk, count, results);
    for (int i = 0; i < count; ++i) samples[i] = (elsewhere >> i & 1) != 0 ? sampleOne(field_, points[i]) : results[i];
}

} // namespace vdbounce::bench
