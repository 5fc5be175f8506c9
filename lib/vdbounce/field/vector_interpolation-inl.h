// SPDX-License-Identifier: Apache-2.0
//
// Trilinear phi and interpolated central differences (lecture, slide 28) of several points at once: each point has four
// lanes of a vector, in which lie the four voxels of one row along z. 12 rows are loaded for a point, added up with
// weights along x, then y, then z; the four lanes of the four results are transposed and added in the end. That needs
// no gather instructions, which were slower than row loads.
//
// No multiplication is fused with an addition, and each point's operations and their order are the same for any width:
// so all targets give the same bits.

// Included once for each target, as Highway has it, so no ordinary guard.
#if defined(VDBOUNCE_VECTOR_INTERPOLATION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VDBOUNCE_VECTOR_INTERPOLATION_INL_H
#undef VDBOUNCE_VECTOR_INTERPOLATION_INL_H
#else
#define VDBOUNCE_VECTOR_INTERPOLATION_INL_H
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

// (phi, gx, gy, gz) of kPointsPerVector points in stored units and index space, in the four lanes of each.
template <Storage storage>
HWY_INLINE V interpolate(const typename Stored<storage>::Type* const* from, const float* x, const float* y,
                         const float* z)
{
    const Lanes d;
    const V one = hn::Set(d, 1.0f);
    const V x1 = ofEachPoint(x);
    const V y1 = ofEachPoint(y);
    const V z1 = ofEachPoint(z);
    const V x0 = hn::Sub(one, x1);
    const V y0 = hn::Sub(one, y1);

    V phi[4];   // along x, at the four places along y
    V twice[2]; // twice the central differences along x, at the two middle ones
    for (int j = 0; j < 4; ++j) {
        const V below = Stored<storage>::load(from, kStrideX + j * kStrideY);
        const V above = Stored<storage>::load(from, 2 * kStrideX + j * kStrideY);
        phi[j] = blend(below, above, x0, x1);
        if (j == 1 || j == 2)
            twice[j - 1] = blend(hn::Sub(above, Stored<storage>::load(from, j * kStrideY)),
                                 hn::Sub(Stored<storage>::load(from, 3 * kStrideX + j * kStrideY), below), x0, x1);
    }
    const V value = blend(phi[1], phi[2], y0, y1);
    const V alongX = blend(twice[0], twice[1], y0, y1);
    const V alongY = blend(hn::Sub(phi[2], phi[0]), hn::Sub(phi[3], phi[1]), y0, y1);

    // Weights of the four values along z, each linear in z: those of the value, half of those for the two doubled
    // differences, and those of the value's own central differences.
    alignas(16) static constexpr float kValue[2][4] = {{0.0f, 1.0f, 0.0f, 0.0f}, {0.0f, -1.0f, 1.0f, 0.0f}};
    alignas(16) static constexpr float kSlope[2][4] = {{-0.5f, 0.0f, 0.5f, 0.0f}, {0.5f, -0.5f, -0.5f, 0.5f}};
    const V valueWeight = hn::Add(everyPoint(kValue[0]), hn::Mul(everyPoint(kValue[1]), z1));
    const V halfWeight = hn::Mul(hn::Set(d, 0.5f), valueWeight);
    const V slopeWeight = hn::Add(everyPoint(kSlope[0]), hn::Mul(everyPoint(kSlope[1]), z1));
    const V a = hn::Mul(value, valueWeight);
    const V b = hn::Mul(alongX, halfWeight);
    const V c = hn::Mul(alongY, halfWeight);
    const V e = hn::Mul(value, slopeWeight);

    // Transposes the four lanes of each point, then adds.
    const hn::Repartition<double, Lanes> pairs;
    const auto ac0 = hn::BitCast(pairs, hn::InterleaveLower(d, a, b));
    const auto ac1 = hn::BitCast(pairs, hn::InterleaveUpper(d, a, b));
    const auto be0 = hn::BitCast(pairs, hn::InterleaveLower(d, c, e));
    const auto be1 = hn::BitCast(pairs, hn::InterleaveUpper(d, c, e));
    const V lane0 = hn::BitCast(d, hn::InterleaveLower(pairs, ac0, be0));
    const V lane1 = hn::BitCast(d, hn::InterleaveUpper(pairs, ac0, be0));
    const V lane2 = hn::BitCast(d, hn::InterleaveLower(pairs, ac1, be1));
    const V lane3 = hn::BitCast(d, hn::InterleaveUpper(pairs, ac1, be1));
    return hn::Add(hn::Add(lane0, lane1), hn::Add(lane2, lane3));
}

// From stored units and index space to the world's.
HWY_INLINE V toWorld(const VectorField& field, V sample)
{
    V world = hn::Mul(hn::Broadcast<0>(sample), everyPoint(field.columns[0]));
    world = hn::Add(world, hn::Mul(hn::Broadcast<1>(sample), everyPoint(field.columns[1])));
    world = hn::Add(world, hn::Mul(hn::Broadcast<2>(sample), everyPoint(field.columns[2])));
    return hn::Add(world, hn::Mul(hn::Broadcast<3>(sample), everyPoint(field.columns[3])));
}

} // namespace HWY_NAMESPACE
} // namespace vdbounce
HWY_AFTER_NAMESPACE();

#endif
