// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/leaf_distances.h"

#include "vdbounce/base/parallel.h"

#include <algorithm>

namespace vdbounce {
namespace {

constexpr std::size_t kCellsPerTask = 16384;
constexpr std::uint8_t kFarthest = 255;

// Every block counts: few hold nothing but the background.
bool mayHoldLess(const LeafBlocks& blocks, const Vec3i& voxel, float background)
{
    const LeafBlocks::Entry entry = blocks.entryAt(voxel);
    return entry.isBlock() || blocks.tileValue(entry) < background;
}

} // namespace

LeafDistances::LeafDistances(const LeafBlocks& blocks, const Box& indexBox, float background)
{
    if (indexBox.empty()) return;
    const auto leafOf = [](const Vec3d& index) {
        return Vec3i(index.cast<int>().unaryExpr([](int v) { return v >> BlockLayout::kLeafBits; }));
    };
    min_ = leafOf(indexBox.min);
    const Vec3i size = leafOf(indexBox.max) - min_ + Vec3i::Ones();
    if (size.cast<double>().prod() > double(kMostCells)) return;
    size_ = size;
    between_.resize(std::size_t(size_.cast<double>().prod()));
    forEachIndex(between_.size(), kCellsPerTask, [&](std::size_t i) {
        const auto z = std::size_t(size_.z());
        const auto y = std::size_t(size_.y());
        const Vec3i cell = min_ + Vec3i(int(i / z / y), int(i / z % y), int(i % z));
        between_[i] = mayHoldLess(blocks, BlockLayout::kLeafSide * cell, background) ? 0 : kFarthest;
    });
    spread(true);
    spread(false);
    // From steps between cells to cells between them.
    for (std::uint8_t& value : between_) value = value > 0 ? std::uint8_t(value - 1) : std::uint8_t(0);
}

// One of the two sweeps of the chessboard distance transform (Rosenfeld and Pfaltz 1968): each cell is at most one step
// farther than those of its 26 neighbours that come before it.
void LeafDistances::spread(bool forward)
{
    const int cells = int(between_.size());
    for (int k = 0; k < cells; ++k) {
        const int i = forward ? k : cells - 1 - k;
        const Vec3i cell(i / size_.z() / size_.y(), i / size_.z() % size_.y(), i % size_.z());
        std::uint8_t& value = between_[std::size_t(i)];
        for (int n = 0; n < 13 && value > 0; ++n) {
            const Vec3i step = (forward ? 1 : -1) * Vec3i(n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1);
            const Vec3i other = cell + step;
            if ((other.array() < 0).any() || (other.array() >= size_.array()).any()) continue;
            value = std::min(value, std::uint8_t(std::min(254, int(between_[placeOf(other)])) + 1));
        }
    }
}

} // namespace vdbounce
