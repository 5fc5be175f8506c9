// SPDX-License-Identifier: Apache-2.0

// See field/vector_lookup.cpp: the tests compare all targets.
#define HWY_BROKEN_EMU128 0

// The rest of this file is compiled once for each target, which needs this order.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vdbounce/build/reach_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "vdbounce/build/reach_test.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace vdbounce {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Boxes = hn::CappedTag<float, 8>;
using B = hn::Vec<Boxes>;

// How far a box is from some of the eight along one axis; none where they overlap.
HWY_INLINE B apart(const FloatBox& box, const EightBoxes& eight, std::size_t axis, std::size_t first)
{
    const Boxes d;
    const B above = hn::Sub(hn::Load(d, eight.min[axis] + first), hn::Set(d, box.max[axis]));
    const B below = hn::Sub(hn::Set(d, box.min[axis]), hn::Load(d, eight.max[axis] + first));
    return hn::Max(hn::Max(above, below), hn::Zero(d));
}

void testAll(const FloatBox* boxes, const std::uint32_t* list, std::size_t count, const EightBoxes& eight,
             float reachSquared, std::uint8_t* reached)
{
    const Boxes d;
    const B limit = hn::Set(d, reachSquared);
    for (std::size_t i = 0; i < count; ++i) {
        const FloatBox& box = boxes[list[i]];
        unsigned all = 0;
        for (std::size_t first = 0; first < 8; first += hn::Lanes(d)) {
            const B x = apart(box, eight, 0, first);
            const B y = apart(box, eight, 1, first);
            const B z = apart(box, eight, 2, first);
            const B squared = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
            std::uint8_t bits[8];
            hn::StoreMaskBits(d, hn::Le(squared, limit), bits);
            all |= unsigned(bits[0]) << first;
        }
        reached[i] = static_cast<std::uint8_t>(all);
    }
}

} // namespace HWY_NAMESPACE
} // namespace vdbounce
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vdbounce {

HWY_EXPORT(testAll);

void findReached(const FloatBox* boxes, const std::uint32_t* list, std::size_t count, const EightBoxes& eight,
                 float reachSquared, std::uint8_t* reached)
{
    HWY_DYNAMIC_DISPATCH(testAll)(boxes, list, count, eight, reachSquared, reached);
}

} // namespace vdbounce
#endif
