// SPDX-License-Identifier: Apache-2.0

// See field/vector_lookup.cpp: the tests compare all targets.
#define HWY_BROKEN_EMU128 0

// The rest of this file is compiled once for each target, which needs this order.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vdbounce/implicit/ball_reach.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "vdbounce/implicit/ball_reach.h"
// clang-format on

#ifndef VDBOUNCE_BALL_REACH_MARGIN
#define VDBOUNCE_BALL_REACH_MARGIN
namespace vdbounce {
namespace {

// What rounding of squares takes, many times over.
constexpr double kReachMargin = 1.0 + 1e-9;

} // namespace
} // namespace vdbounce
#endif

HWY_BEFORE_NAMESPACE();
namespace vdbounce {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Balls = hn::CappedTag<double, 8>;
using B = hn::Vec<Balls>;

// Squared distance along one axis to one half of the box.
HWY_INLINE B apart(B centre, const BoxHalves& halves, int axis, int half)
{
    const Balls d;
    const B below = hn::Sub(hn::Set(d, halves.min[axis][half]), centre);
    const B above = hn::Sub(centre, hn::Set(d, halves.max[axis][half]));
    const B distance = hn::Max(hn::Max(below, above), hn::Zero(d));
    return hn::Mul(distance, distance);
}

HWY_INLINE void testVector(const double* balls, const BallReach& reach, const BoxHalves& halves, std::uint8_t* reached)
{
    const Balls d;
    B x, y, z, radius;
    hn::LoadInterleaved4(d, balls, x, y, z, radius);
    B limit = hn::Add(hn::Mul(radius, hn::Set(d, reach.perRadius)), hn::Set(d, reach.beyond));
    limit = hn::Mul(hn::Mul(limit, limit), hn::Set(d, kReachMargin));
    const B xs[2] = {apart(x, halves, 0, 0), apart(x, halves, 0, 1)};
    const B ys[2] = {apart(y, halves, 1, 0), apart(y, halves, 1, 1)};
    const B zs[2] = {apart(z, halves, 2, 0), apart(z, halves, 2, 1)};
    B all = hn::Zero(d); // a bit of each lane's last byte for each eighth
    for (int i = 0; i < 8; ++i) {
        const B squared = hn::Add(hn::Add(xs[i >> 2], ys[i >> 1 & 1]), zs[i & 1]);
        const B bit = hn::BitCast(d, hn::Set(hn::RebindToUnsigned<Balls>(), std::uint64_t(1) << i));
        all = hn::Or(all, hn::IfThenElseZero(hn::Le(squared, limit), bit));
    }
    hn::StoreU(hn::TruncateTo(hn::Rebind<std::uint8_t, Balls>(), hn::BitCast(hn::RebindToUnsigned<Balls>(), all)),
               hn::Rebind<std::uint8_t, Balls>(), reached);
}

void testAll(const Ball* balls, std::size_t count, const BallReach& reach, const BoxHalves& halves,
             std::uint8_t* reached)
{
    static_assert(sizeof(Ball) == 4 * sizeof(double));
    const std::size_t lanes = hn::Lanes(Balls());
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) testVector(&balls[i].x, reach, halves, reached + i);
    if (i == count) return;
    double rest[4 * 8] = {};
    std::uint8_t found[8];
    for (std::size_t k = i; k < count; ++k) {
        const double values[4] = {balls[k].x, balls[k].y, balls[k].z, balls[k].radius};
        for (std::size_t v = 0; v < 4; ++v) rest[4 * (k - i) + v] = values[v];
    }
    testVector(rest, reach, halves, found);
    for (std::size_t k = i; k < count; ++k) reached[k] = found[k - i];
}

} // namespace HWY_NAMESPACE
} // namespace vdbounce
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vdbounce {

HWY_EXPORT(testAll);

void findReachedEighths(const Ball* balls, std::size_t count, const BallReach& reach, const BoxHalves& halves,
                        std::uint8_t* reached)
{
    HWY_DYNAMIC_DISPATCH(testAll)(balls, count, reach, halves, reached);
}

} // namespace vdbounce
#endif
