// SPDX-License-Identifier: Apache-2.0
//
// The rows of a leaf, eight voxels along z, as vectors. Compiled once for each target.

#if defined(VDBOUNCE_IMPLICIT_LEAF_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VDBOUNCE_IMPLICIT_LEAF_ROWS_INL_H_
#undef VDBOUNCE_IMPLICIT_LEAF_ROWS_INL_H_
#else
#define VDBOUNCE_IMPLICIT_LEAF_ROWS_INL_H_
#endif

#include "vdbounce/base/vector.h"
#include "vdbounce/implicit/ball_list.h"

#include <cstddef>
#include <cstdint>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vdbounce {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using RowDoubles = hn::CappedTag<double, 8>;
using RowFloats = hn::CappedTag<float, 8>;

// Of a vector of at most eight lanes.
template <class D, class Mask> HWY_INLINE std::uint64_t bitsOf(D d, Mask mask)
{
    std::uint8_t bits[8];
    hn::StoreMaskBits(d, mask, bits);
    return bits[0];
}

// The squared distances of a leaf's voxels from a ball's centre, axis by axis.
struct LeafOffsets {
    alignas(64) double squared[3][8];

    // `origin` is the leaf's lowest voxel.
    HWY_INLINE LeafOffsets(const Ball& ball, const Vec3d& origin)
    {
        const RowDoubles d;
        const double centre[3] = {ball.x - origin.x(), ball.y - origin.y(), ball.z - origin.z()};
        for (std::size_t i = 0; i < 8; i += hn::Lanes(d)) {
            const auto place = hn::Iota(d, double(i));
            for (int axis = 0; axis < 3; ++axis) {
                const auto offset = hn::Sub(place, hn::Set(d, centre[axis]));
                hn::Store(hn::Mul(offset, offset), d, squared[axis] + i);
            }
        }
    }
};

HWY_INLINE void toFloats(const double (&from)[8], float (&to)[8])
{
    const RowDoubles d;
    const hn::Rebind<float, RowDoubles> df;
    for (std::size_t i = 0; i < 8; i += hn::Lanes(d)) hn::Store(hn::DemoteTo(df, hn::Load(d, from + i)), df, to + i);
}

// rows[8 x + y] = alongX[x] + alongY[y]
template <class T> HWY_INLINE void sumRows(const T (&alongX)[8], const T (&alongY)[8], T (&rows)[64])
{
    const hn::CappedTag<T, 8> d;
    for (std::size_t y = 0; y < 8; y += hn::Lanes(d)) {
        const auto along = hn::Load(d, alongY + y);
        for (std::size_t x = 0; x < 8; ++x) hn::Store(hn::Add(hn::Set(d, alongX[x]), along), d, rows + 8 * x + y);
    }
}

// A bit for each row whose value is below `limit`.
template <class T> HWY_INLINE std::uint64_t rowsBelow(const T (&rows)[64], T limit)
{
    const hn::CappedTag<T, 8> d;
    const auto bound = hn::Set(d, limit);
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < 64; i += hn::Lanes(d)) bits |= bitsOf(d, hn::Lt(hn::Load(d, rows + i), bound)) << i;
    return bits;
}

} // namespace HWY_NAMESPACE
} // namespace vdbounce
HWY_AFTER_NAMESPACE();

#endif
