// SPDX-License-Identifier: Apache-2.0
#define HWY_BROKEN_EMU128 0 // as in vdbounce/field/vector_lookup.cpp

// The rest of this file is compiled once for each target, which needs this order.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/precomputed_lookup.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "vdbounce/field/vector_rows-inl.h"
#include "bench/precomputed_lookup.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace vdbounce {
namespace HWY_NAMESPACE {

using Layout = bench::PrecomputedLayout;

// Of each voxel of a leaf, by where the 4^3 values around the cell above it begin in a BlockLayout: where that voxel is
// here. Looked up, since two divisions a point cost a fifth of everything.
struct Places {
    constexpr Places()
    {
        for (int x = 0; x < BlockLayout::kLeafSide; ++x) {
            for (int y = 0; y < BlockLayout::kLeafSide; ++y) {
                for (int z = 0; z < BlockLayout::kLeafSide; ++z) {
                    of[x * kStrideX + y * kStrideY + z] =
                        std::uint16_t(x * Layout::kStrideX + y * Layout::kStrideY + z * Layout::kVoxel);
                }
            }
        }
    }
    std::uint16_t of[BlockLayout::kSize] = {};
};
constexpr Places kPlaces;

// Finds the voxels below the points, and asks for their rows: they come while the first are interpolated.
HWY_INLINE void voxelsBelow(const float* voxels, const PointChunk& chunk, int count, const float** below)
{
    for (int i = 0; i < count; ++i) {
        below[i] = voxels + std::size_t(chunk.entry[i]) * Layout::kSize + kPlaces.of[chunk.offset[i]];
        for (const int row : {0, Layout::kStrideY, Layout::kStrideX, Layout::kStrideX + Layout::kStrideY})
            __builtin_prefetch(below[i] + row);
    }
    // Vectors go on beyond the last point.
    for (int i = count; i % kPointsPerVector != 0; ++i) below[i] = below[0];
}

void interpolateVoxels(const float* voxels, const PointChunk& chunk, int count, PointSample* samples)
{
    const float* below[kPointsPerChunk];
    voxelsBelow(voxels, chunk, count, below);
    const Lanes d;
    const V one = hn::Set(d, 1.0f);
    for (int i = 0; i < count; i += kPointsPerVector) {
        const V x1 = ofEachPoint(chunk.at[0] + i);
        const V y1 = ofEachPoint(chunk.at[1] + i);
        const V z1 = ofEachPoint(chunk.at[2] + i);
        const V z0 = hn::Sub(one, z1);
        const V y0 = hn::Sub(one, y1);
        const auto alongZ = [&](int row) {
            return blend(rows(d, below + i, row), rows(d, below + i, row + Layout::kVoxel), z0, z1);
        };
        const auto alongYZ = [&](int x) { return blend(alongZ(x), alongZ(x + Layout::kStrideY), y0, y1); };
        hn::StoreU(blend(alongYZ(0), alongYZ(Layout::kStrideX), hn::Sub(one, x1), x1), d, &samples[i].phi);
    }
}

} // namespace HWY_NAMESPACE
} // namespace vdbounce
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vdbounce {

HWY_EXPORT(interpolateVoxels);

void bench::interpolatePrecomputed(const float* voxels, const PointChunk& chunk, int count, PointSample* samples)
{
    HWY_DYNAMIC_DISPATCH(interpolateVoxels)(voxels, chunk, count, samples);
}

} // namespace vdbounce
#endif
