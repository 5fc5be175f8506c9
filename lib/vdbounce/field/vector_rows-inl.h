// SPDX-License-Identifier: Apache-2.0
//
// How vector code takes voxels from memory: each point has four lanes of a vector, in which lie the four voxels of one
// row along z. That needs no gather instructions, which were slower than row loads.

// Included once for each target, as Highway has it, so no ordinary guard.
#if defined(VDBOUNCE_VECTOR_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VDBOUNCE_VECTOR_ROWS_INL_H
#undef VDBOUNCE_VECTOR_ROWS_INL_H
#else
#define VDBOUNCE_VECTOR_ROWS_INL_H
#endif

#include "vdbounce/field/vector_lookup.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vdbounce {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kStrideX = BlockLayout::kStrideX;
constexpr int kStrideY = BlockLayout::kStrideY;
constexpr int kLanesPerPoint = 4;

// Rows of four values, one a point, each from its own address.
template <class D, class T> HWY_INLINE hn::Vec<D> rows(D d, const T* const* from, int offset)
{
    if constexpr (int(hn::MaxLanes(D())) <= kLanesPerPoint) {
        return hn::LoadU(d, from[0] + offset);
    } else {
        const hn::Half<D> half;
        const auto low = rows(half, from, offset);
        return hn::Combine(d, rows(half, from + hn::MaxLanes(D()) / (2 * kLanesPerPoint), offset), low);
    }
}

using Lanes = hn::CappedTag<float, 16>;
constexpr int kPointsPerVector = int(hn::MaxLanes(Lanes())) / kLanesPerPoint;

template <Storage storage> struct Stored;
template <> struct Stored<Storage::Float> {
    using Type = float;
    static HWY_INLINE hn::Vec<Lanes> load(const float* const* from, int offset) { return rows(Lanes(), from, offset); }
};
template <> struct Stored<Storage::Half> {
    using Type = std::uint16_t;
    static HWY_INLINE hn::Vec<Lanes> load(const std::uint16_t* const* from, int offset)
    {
        const hn::Rebind<hwy::float16_t, Lanes> dh;
        return hn::PromoteTo(Lanes(), hn::BitCast(dh, rows(hn::Rebind<std::uint16_t, Lanes>(), from, offset)));
    }
};
template <> struct Stored<Storage::Fixed8> {
    using Type = std::uint8_t;
    static HWY_INLINE hn::Vec<Lanes> load(const std::uint8_t* const* from, int offset)
    {
        const hn::Rebind<std::int32_t, Lanes> di;
        return hn::ConvertTo(Lanes(), hn::PromoteTo(di, rows(hn::Rebind<std::uint8_t, Lanes>(), from, offset)));
    }
};

using V = hn::Vec<Lanes>;

// The rows of the 4^3 values around the cells of kPointsPerVector points.
template <Storage storage> struct Neighbourhoods {
    const typename Stored<storage>::Type* from[kPointsPerVector];

    HWY_INLINE V at(int x, int y) const { return Stored<storage>::load(from, x * kStrideX + y * kStrideY); }
};

// The same four values for every point.
HWY_INLINE V everyPoint(const float (&values)[4]) { return hn::LoadDup128(Lanes(), values); }

// Lane k of the four values that begin at `values` for all lanes of point k.
HWY_INLINE V ofEachPoint(const float* values)
{
    alignas(64) static constexpr std::int32_t kPoint[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
    const Lanes d;
    return hn::TableLookupLanes(hn::LoadDup128(d, values), hn::SetTableIndices(d, kPoint));
}

HWY_INLINE V blend(V low, V high, V lowWeight, V highWeight)
{
    return hn::Add(hn::Mul(low, lowWeight), hn::Mul(high, highWeight));
}

// Four vectors, each with four terms a point, to the four sums of each point in its four lanes.
HWY_INLINE V sums(V a, V b, V c, V e)
{
    const Lanes d;
    const hn::Repartition<double, Lanes> pairs;
    const auto ab0 = hn::BitCast(pairs, hn::InterleaveLower(d, a, b));
    const auto ab1 = hn::BitCast(pairs, hn::InterleaveUpper(d, a, b));
    const auto ce0 = hn::BitCast(pairs, hn::InterleaveLower(d, c, e));
    const auto ce1 = hn::BitCast(pairs, hn::InterleaveUpper(d, c, e));
    const V lane0 = hn::BitCast(d, hn::InterleaveLower(pairs, ab0, ce0));
    const V lane1 = hn::BitCast(d, hn::InterleaveUpper(pairs, ab0, ce0));
    const V lane2 = hn::BitCast(d, hn::InterleaveLower(pairs, ab1, ce1));
    const V lane3 = hn::BitCast(d, hn::InterleaveUpper(pairs, ab1, ce1));
    return hn::Add(hn::Add(lane0, lane1), hn::Add(lane2, lane3));
}

} // namespace HWY_NAMESPACE
} // namespace vdbounce
HWY_AFTER_NAMESPACE();

#endif
