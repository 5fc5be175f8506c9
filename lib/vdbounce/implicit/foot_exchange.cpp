// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/foot_exchange.h"

namespace vdbounce {
namespace {

class Exchange {
public:
    Exchange(FootLeaf& leaf, const VoxelMetric& metric, Margin margin) : leaf_(leaf), metric_(metric), margin_(margin)
    {
    }

    // Voxel `to` is one step (1 or -1) along `axis` from voxel `from` of `source`.
    void offer(const FootLeaf& source, int from, int to, int axis, int step)
    {
        if (source.patch[from] == FootLeaf::kNone) return;
        const float way[3] = {source.way[0][from], source.way[1][from], source.way[2][from]};
        float mapped[3];
        metric_.apply(way, mapped);
        const float squared = source.squared[from] - float(2 * step) * mapped[axis] + metric_.g[axis];
        if (!(squared < margin_.factor * leaf_.squared[to] - margin_.offset)) return;
        for (int a = 0; a < 3; ++a) leaf_.way[a][to] = way[a];
        leaf_.way[axis][to] -= float(step);
        leaf_.squared[to] = squared;
        leaf_.patch[to] = source.patch[from];
        changed_[std::size_t(to >> 6)] |= std::uint64_t(1) << (to & 63);
    }

    void sweep(int axis, int step)
    {
        const int stride = 64 >> (3 * axis);
        for (int v = 0; v < FootLeaf::kVoxels; ++v) {
            const int to = step > 0 ? v : FootLeaf::kVoxels - 1 - v;
            const int place = (to / stride & 7) - step;
            if (place >= 0 && place < 8) offer(leaf_, to - step * stride, to, axis, step);
        }
    }

    void import(const FootLeaf& beside, int axis, int step)
    {
        const int stride = 64 >> (3 * axis);
        for (int v = 0; v < FootLeaf::kVoxels; ++v) {
            if ((v / stride & 7) == (step > 0 ? 0 : 7)) offer(beside, v + 7 * step * stride, v, axis, step);
        }
    }

    const VoxelSet& changed() const { return changed_; }

private:
    FootLeaf& leaf_;
    const VoxelMetric& metric_;
    Margin margin_;
    VoxelSet changed_{};
};

} // namespace

bool exchangeFeet(FootLeaves& leaves, std::size_t i, const VoxelMetric& metric, Margin margin, VoxelSet* changed)
{
    FootLeaf& leaf = *leaves[i];
    Exchange exchange(leaf, metric, margin);
    for (int face = 0; face < 6; ++face) {
        const std::int32_t beside = leaf.neighbours[std::size_t(face)];
        if (beside >= 0) exchange.import(*leaves[std::size_t(beside)], face / 2, face % 2 == 0 ? 1 : -1);
    }
    for (int round = 0; round < 2; ++round) {
        for (int axis = 0; axis < 3; ++axis) {
            exchange.sweep(axis, 1);
            exchange.sweep(axis, -1);
        }
    }
    bool any = false;
    for (const std::uint64_t word : exchange.changed()) any = any || word != 0;
    if (changed != nullptr) *changed = exchange.changed();
    return any;
}

} // namespace vdbounce
