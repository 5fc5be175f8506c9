// SPDX-License-Identifier: Apache-2.0

// See field/vector_lookup.cpp: the tests compare all targets.
#define HWY_BROKEN_EMU128 0

// The rest of this file is compiled once for each target, which needs this order.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vdbounce/build/nearest_in_leaf.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "vdbounce/build/nearest_in_leaf.h"
#include "vdbounce/build/triangle_forms-inl.h"
// clang-format on

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace vdbounce {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Row = hn::CappedTag<float, 8>; // voxels along z, a whole row where the processor has the width
using RowIndex = hn::RebindToSigned<Row>;

// One linear function along a row of voxels, and its change from one row to the next.
struct Form {
    hn::Vec<Row> row;
    float stepY;

    Form(const TriangleForms& forms, int number, int lane, hn::Vec<Row> z, float x, float y)
    {
        const Row d;
        const float* gradient = forms.gradient[number][0] + lane;
        const float along = gradient[0] * x + gradient[TriangleForms::kLanes] * y + forms.constant[number][lane];
        row = hn::Add(hn::Mul(hn::Set(d, gradient[2 * TriangleForms::kLanes]), z), hn::Set(d, along));
        stepY = gradient[TriangleForms::kLanes];
    }
    void toNextRow() { row = hn::Add(row, hn::Set(Row(), stepY)); }
};

// Squared distance within the plane to one edge, from the functions "across" (outwards) and "before" its start.
HWY_INLINE hn::Vec<Row> edgeDistance(hn::Vec<Row> across, hn::Vec<Row> before, hn::Vec<Row> minusLength)
{
    const auto beyond = hn::Max(hn::Max(before, hn::Sub(minusLength, before)), hn::Zero(Row()));
    return hn::Add(hn::Mul(across, across), hn::Mul(beyond, beyond));
}

// All rows of one x and some z within the triangle's reach.
HWY_INLINE void searchSlice(const TriangleForms& forms, int lane, std::uint32_t triangle, int x, int z,
                            NearestInLeaf& nearest)
{
    const Row d;
    const RowIndex di;
    const int firstY = forms.low[1][lane];
    const int lastY = forms.high[1][lane];
    const auto zs = hn::Iota(d, float(z));
    Form height(forms, 0, lane, zs, float(x), float(firstY));
    Form across[3] = {{forms, 1, lane, zs, float(x), float(firstY)},
                      {forms, 2, lane, zs, float(x), float(firstY)},
                      {forms, 3, lane, zs, float(x), float(firstY)}};
    Form before[3] = {{forms, 4, lane, zs, float(x), float(firstY)},
                      {forms, 5, lane, zs, float(x), float(firstY)},
                      {forms, 6, lane, zs, float(x), float(firstY)}};
    const hn::Vec<Row> minusLength[3] = {hn::Set(d, forms.minusLength[0][lane]), hn::Set(d, forms.minusLength[1][lane]),
                                         hn::Set(d, forms.minusLength[2][lane])};
    const auto number = hn::Set(di, static_cast<std::int32_t>(triangle));
    float* squared = nearest.squared + 64 * x + 8 * firstY + z;
    auto* found = reinterpret_cast<std::int32_t*>(nearest.triangle) + 64 * x + 8 * firstY + z;
    for (int y = firstY; y <= lastY; ++y, squared += 8, found += 8) {
        const auto outside = hn::Max(hn::Max(across[0].row, across[1].row), across[2].row);
        const auto edge = hn::Min(hn::Min(edgeDistance(across[0].row, before[0].row, minusLength[0]),
                                          edgeDistance(across[1].row, before[1].row, minusLength[1])),
                                  edgeDistance(across[2].row, before[2].row, minusLength[2]));
        const auto inPlane = hn::IfThenElseZero(hn::Ge(outside, hn::Zero(d)), edge);
        const auto distance = hn::Add(hn::Mul(height.row, height.row), inPlane);
        const auto best = hn::Load(d, squared);
        const auto nearer = hn::Lt(distance, best);
        if (!hn::AllFalse(d, nearer)) {
            hn::Store(hn::Min(distance, best), d, squared);
            hn::Store(hn::IfThenElse(hn::RebindMask(di, nearer), number, hn::Load(di, found)), di, found);
        }
        height.toNextRow();
        for (int edgeNumber = 0; edgeNumber < 3; ++edgeNumber) {
            across[edgeNumber].toNextRow();
            before[edgeNumber].toNextRow();
        }
    }
}

void searchLeaf(const TriangleMesh& mesh, const std::uint32_t* list, std::size_t count, const LeafPlace& place,
                NearestInLeaf& nearest)
{
    constexpr std::size_t kChunk = TriangleForms::kLanes;
    TriangleForms forms;
    for (std::size_t begin = 0; begin < count; begin += kChunk) {
        const std::size_t size = std::min(kChunk, count - begin);
        makeForms(mesh, list + begin, size, place, forms);
        for (std::size_t i = 0; i < size; ++i) {
            const int lane = int(i);
            if (forms.low[1][lane] > forms.high[1][lane]) continue;
            for (int z = 0; z < 8; z += int(hn::Lanes(Row()))) {
                for (int x = forms.low[0][lane]; x <= forms.high[0][lane]; ++x)
                    searchSlice(forms, lane, list[begin + i], x, z, nearest);
            }
        }
    }
}

} // namespace HWY_NAMESPACE
} // namespace vdbounce
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vdbounce {

HWY_EXPORT(searchLeaf);

void NearestInLeaf::clear(double reach)
{
    std::fill_n(squared, kVoxels, float(reach * reach));
    std::fill_n(triangle, kVoxels, kNone);
}

void findNearestInLeaf(const TriangleMesh& mesh, const std::uint32_t* list, std::size_t count, const LeafPlace& place,
                       NearestInLeaf& nearest)
{
    HWY_DYNAMIC_DISPATCH(searchLeaf)(mesh, list, count, place, nearest);
}

} // namespace vdbounce
#endif
