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

// Voxels side by side: half a row along z, a row, or two neighbouring rows, as wide as the processor is.
using Span = hn::CappedTag<float, 16>;
using SpanIndex = hn::RebindToSigned<Span>;
using V = hn::Vec<Span>;

// How a span lies in a slice of 8 x 8 voxels along y and z.
struct SpanShape {
    int rows; // that it covers, at least one
    int cols;

    SpanShape() : rows(std::max(1, int(hn::Lanes(Span())) / 8)), cols(std::min(8, int(hn::Lanes(Span())))) {}
    V offsetY() const { return hn::ConvertTo(Span(), hn::ShiftRight<3>(hn::Iota(SpanIndex(), 0))); }
    V offsetZ() const { return hn::ConvertTo(Span(), hn::And(hn::Iota(SpanIndex(), 0), hn::Set(SpanIndex(), 7))); }
};

// The functions of one triangle along a span, in the order of TriangleForms.
struct Forms {
    V at[TriangleForms::kForms];

    // Where y is 0.
    HWY_INLINE Forms(const TriangleForms& forms, int lane, const SpanShape& shape, float x, float z)
    {
        const Span d;
        const V zs = hn::Add(shape.offsetZ(), hn::Set(d, z));
        for (int i = 0; i < TriangleForms::kForms; ++i) {
            const float along = forms.gradient[i][0][lane] * x + forms.constant[i][lane];
            at[i] = hn::Add(hn::Set(d, along), hn::Mul(hn::Set(d, forms.gradient[i][2][lane]), zs));
        }
    }

    // A step from row to row would be rounded otherwise where spans are two rows wide.
    HWY_INLINE Forms(const Forms& first, const V (&alongY)[TriangleForms::kForms], V ys)
    {
        for (int i = 0; i < TriangleForms::kForms; ++i) at[i] = hn::Add(first.at[i], hn::Mul(alongY[i], ys));
    }
};

// Squared distance within the plane to one edge, from the functions "across" (outwards) and "before" its start.
HWY_INLINE V edgeDistance(V across, V before, V minusLength)
{
    const V beyond = hn::Max(hn::Max(before, hn::Sub(minusLength, before)), hn::Zero(Span()));
    return hn::Add(hn::Mul(across, across), hn::Mul(beyond, beyond));
}

HWY_INLINE V squaredDistance(const Forms& forms, const V (&minusLength)[3])
{
    const V* across = forms.at + 1;
    const V* before = forms.at + 4;
    const V outside = hn::Max(hn::Max(across[0], across[1]), across[2]);
    const V edge = hn::Min(
        hn::Min(edgeDistance(across[0], before[0], minusLength[0]), edgeDistance(across[1], before[1], minusLength[1])),
        edgeDistance(across[2], before[2], minusLength[2]));
    const V inPlane = hn::IfThenElseZero(hn::Ge(outside, hn::Zero(Span())), edge);
    return hn::Add(hn::Mul(forms.at[0], forms.at[0]), inPlane);
}

// All voxels within the triangle's reach.
HWY_INLINE void searchTriangle(const TriangleForms& forms, int lane, std::uint32_t triangle, NearestInLeaf& nearest)
{
    const Span d;
    const SpanIndex di;
    const SpanShape shape;
    const int firstY = forms.low[1][lane] / shape.rows * shape.rows;
    const int lastY = forms.high[1][lane];
    const V minusLength[3] = {hn::Set(d, forms.minusLength[0][lane]), hn::Set(d, forms.minusLength[1][lane]),
                              hn::Set(d, forms.minusLength[2][lane])};
    const auto number = hn::Set(di, static_cast<std::int32_t>(triangle));
    V alongY[TriangleForms::kForms];
    for (int i = 0; i < TriangleForms::kForms; ++i) alongY[i] = hn::Set(d, forms.gradient[i][1][lane]);
    const V offsetY = shape.offsetY();
    for (int z = 0; z < 8; z += shape.cols) {
        for (int x = forms.low[0][lane]; x <= forms.high[0][lane]; ++x) {
            const Forms first(forms, lane, shape, float(x), float(z));
            float* squared = nearest.squared + 64 * x + 8 * firstY + z;
            auto* found = reinterpret_cast<std::int32_t*>(nearest.triangle) + 64 * x + 8 * firstY + z;
            for (int y = firstY; y <= lastY; y += shape.rows) {
                const Forms here(first, alongY, hn::Add(offsetY, hn::Set(d, float(y))));
                const V distance = squaredDistance(here, minusLength);
                const V best = hn::Load(d, squared);
                const auto nearer = hn::Lt(distance, best);
                if (!hn::AllFalse(d, nearer)) {
                    hn::Store(hn::Min(distance, best), d, squared);
                    hn::Store(hn::IfThenElse(hn::RebindMask(di, nearer), number, hn::Load(di, found)), di, found);
                }
                squared += 8 * shape.rows;
                found += 8 * shape.rows;
            }
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
        for (std::size_t i = 0; i < size; ++i) searchTriangle(forms, int(i), list[begin + i], nearest);
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
