// SPDX-License-Identifier: Apache-2.0

// See field/vector_lookup.cpp: the tests compare all targets.
#define HWY_BROKEN_EMU128 0

// The rest of this file is compiled once for each target, which needs this order.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vdbounce/implicit/foot_exchange.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "vdbounce/implicit/foot_exchange.h"
// clang-format on

#include <algorithm>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace vdbounce {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Span = hn::CappedTag<float, 8>;
using SpanIndex = hn::RebindToSigned<Span>;

constexpr int kRow = 8;

// A row of eight voxels along z, wherever it is.
struct Row {
    const float* way[3];
    const float* squared;
    const std::int32_t* patch;

    Row(const FootLeaf& leaf, int first)
        : way{leaf.way[0] + first, leaf.way[1] + first, leaf.way[2] + first}, squared(leaf.squared + first),
          patch(leaf.patch + first)
    {
    }
    Row() = default;
};

// A row with room for as many voxels without points on both sides, to be read shifted.
struct PaddedRow {
    alignas(64) float way[3][3 * kRow] = {};
    alignas(64) float squared[3 * kRow];
    alignas(64) std::int32_t patch[3 * kRow];

    PaddedRow()
    {
        std::fill(std::begin(squared), std::end(squared), std::numeric_limits<float>::infinity());
        std::fill(std::begin(patch), std::end(patch), FootLeaf::kNone);
    }
    void take(const FootLeaf& leaf, int first)
    {
        for (int a = 0; a < 3; ++a) std::copy_n(leaf.way[a] + first, kRow, way[a] + kRow);
        std::copy_n(leaf.squared + first, kRow, squared + kRow);
        std::copy_n(leaf.patch + first, kRow, patch + kRow);
    }
    Row shifted(int by) const
    {
        Row row;
        for (int a = 0; a < 3; ++a) row.way[a] = way[a] + kRow - by;
        row.squared = squared + kRow - by;
        row.patch = patch + kRow - by;
        return row;
    }
};

class Exchange {
public:
    // Everything that the leaf has counts as new where it is `fresh`; else only what is imported.
    Exchange(FootLeaf& leaf, const VoxelMetric& metric, Margin margin, bool fresh) : leaf_(leaf), margin_(margin)
    {
        constexpr int kPlace[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
        for (int a = 0; a < 3; ++a) {
            for (int b = 0; b < 3; ++b) matrix_[a][b] = metric.g[kPlace[a][b]];
        }
        for (int row = 0; fresh && row < 64; ++row) {
            const std::int32_t* patch = leaf.patch + kRow * row;
            const bool any = std::any_of(patch, patch + kRow, [](std::int32_t p) { return p != FootLeaf::kNone; });
            news_ |= std::uint64_t(any ? 1 : 0) << row;
        }
    }

    void import(const FootLeaf& beside, int axis, int step)
    {
        const int from = step > 0 ? 7 : 0;
        const int to = 7 - from;
        for (int i = 0; i < 8; ++i) {
            if (axis == 0) offer(Row(beside, 64 * from + 8 * i), 64 * to + 8 * i, 0, step);
            if (axis == 1) offer(Row(beside, 64 * i + 8 * from), 64 * i + 8 * to, 1, step);
            if (axis == 2) importAcross(beside, i, step);
        }
    }

    // Hands on what is new; true when that made something new again.
    bool sweep()
    {
        std::uint64_t sources = news_;
        news_ = 0;
        for (int axis = 0; axis < 2; ++axis) {
            for (int step = 1; step >= -1; step -= 2) sweepRows(axis, step, sources);
        }
        for (int row = 0; row < 64; ++row) {
            if (((sources | news_) >> row & 1) != 0) sweepRow(kRow * row);
        }
        return news_ != 0;
    }

    const VoxelSet& changed() const { return changed_; }

private:
    void sweepRows(int axis, int step, std::uint64_t sources)
    {
        const int stride = axis == 0 ? 8 : 1;
        const int across = axis == 0 ? 1 : 8;
        for (int i = 1; i < 8; ++i) {
            const int to = stride * (step > 0 ? i : 7 - i);
            for (int j = 0; j < 8; ++j) {
                const int row = to + across * j;
                const int source = row - step * stride;
                if (((sources | news_) >> source & 1) != 0) offer(Row(leaf_, kRow * source), kRow * row, axis, step);
            }
        }
    }

    // Points one, two and four voxels on, so that each reaches all of the row.
    void sweepRow(int first)
    {
        padded_.take(leaf_, first);
        for (int by = 1; by < kRow; by *= 2) {
            for (int sign = 1; sign >= -1; sign -= 2) {
                if (offer(padded_.shifted(sign * by), first, 2, sign * by)) padded_.take(leaf_, first);
            }
        }
    }

    // From the ends of eight rows.
    void importAcross(const FootLeaf& beside, int x, int step)
    {
        const int from = step > 0 ? 7 : 0;
        const int to = 7 - from;
        for (int y = 0; y < 8; ++y) {
            const int row = 64 * x + 8 * y;
            if (beside.patch[row + from] == FootLeaf::kNone) continue;
            for (int a = 0; a < 3; ++a) padded_.way[a][to] = beside.way[a][row + from];
            padded_.squared[to] = beside.squared[row + from];
            padded_.patch[to] = beside.patch[row + from];
            offer(padded_.shifted(kRow), row, 2, step);
            padded_.patch[to] = FootLeaf::kNone;
        }
    }

    // Each voxel of the row at `to` lies `step` along `axis` from its counterpart of `source`.
    // True when one is closer.
    HWY_INLINE bool offer(const Row& source, int to, int axis, int step)
    {
        bool any = false;
        const Span d;
        const SpanIndex di;
        const int lanes = int(hn::Lanes(d));
        const auto twice = hn::Set(d, float(-2 * step));
        const auto whole = hn::Set(d, float(step * step) * matrix_[axis][axis]);
        for (int i = 0; i < kRow; i += lanes) {
            hn::Vec<Span> way[3];
            for (int a = 0; a < 3; ++a) way[a] = hn::LoadU(d, source.way[a] + i);
            const auto mapped = hn::Add(
                hn::Add(hn::Mul(hn::Set(d, matrix_[axis][0]), way[0]), hn::Mul(hn::Set(d, matrix_[axis][1]), way[1])),
                hn::Mul(hn::Set(d, matrix_[axis][2]), way[2]));
            const auto squared = hn::Add(hn::LoadU(d, source.squared + i), hn::Add(hn::Mul(twice, mapped), whole));
            const auto own = hn::LoadU(d, leaf_.squared + to + i);
            const auto patch = hn::LoadU(di, source.patch + i);
            const auto limit = hn::Sub(hn::Mul(hn::Set(d, margin_.factor), own), hn::Set(d, margin_.offset));
            const auto there = hn::RebindMask(d, hn::Gt(patch, hn::Set(di, FootLeaf::kNone)));
            const auto better = hn::And(hn::Lt(squared, limit), there);
            if (hn::AllFalse(d, better)) continue;
            way[axis] = hn::Sub(way[axis], hn::Set(d, float(step)));
            for (int a = 0; a < 3; ++a) {
                float* target = leaf_.way[a] + to + i;
                hn::StoreU(hn::IfThenElse(better, way[a], hn::LoadU(d, target)), d, target);
            }
            hn::StoreU(hn::IfThenElse(better, squared, own), d, leaf_.squared + to + i);
            std::int32_t* number = leaf_.patch + to + i;
            hn::StoreU(hn::IfThenElse(hn::RebindMask(di, better), patch, hn::LoadU(di, number)), di, number);
            std::uint8_t bits[8] = {};
            hn::StoreMaskBits(d, better, bits);
            changed_[std::size_t(to >> 6)] |= std::uint64_t(bits[0]) << ((to & 63) + i);
            any = true;
        }
        news_ |= std::uint64_t(any ? 1 : 0) << (to / kRow);
        return any;
    }

    FootLeaf& leaf_;
    Margin margin_;
    float matrix_[3][3];
    PaddedRow padded_;
    std::uint64_t news_ = 0; // rows whose points have not been handed on
    VoxelSet changed_{};
};

bool exchange(FootLeaves& leaves, std::size_t i, const VoxelMetric& metric, Margin margin, bool fresh,
              VoxelSet& changed)
{
    Exchange exchange(*leaves[i], metric, margin, fresh);
    for (int face = 0; face < 6; ++face) {
        const std::int32_t beside = leaves[i]->neighbours[std::size_t(face)];
        if (beside >= 0) exchange.import(*leaves[std::size_t(beside)], face / 2, face % 2 == 0 ? 1 : -1);
    }
    while (exchange.sweep()) {
    } // ends, since each change makes a distance smaller by the margin
    bool any = false;
    for (const std::uint64_t word : exchange.changed()) any = any || word != 0;
    changed = exchange.changed();
    return any;
}

} // namespace HWY_NAMESPACE
} // namespace vdbounce
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vdbounce {

HWY_EXPORT(exchange);

bool exchangeFeet(FootLeaves& leaves, std::size_t i, const VoxelMetric& metric, Margin margin, bool fresh,
                  VoxelSet& changed)
{
    return HWY_DYNAMIC_DISPATCH(exchange)(leaves, i, metric, margin, fresh, changed);
}

} // namespace vdbounce
#endif
