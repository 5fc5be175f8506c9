// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"
#include "vdbounce/field/leaf_blocks.h"

#include <cstdint>
#include <vector>

namespace vdbounce {

/// How far each leaf-sized cell of a narrow band's box is from those that hold the band or the inside: beyond the band
/// phi tells no more than its width. One byte a cell.
class LeafDistances {
public:
    LeafDistances() = default;

    /// Of the cells in `indexBox`. Empty for boxes of more than kMostCells, where it would take too long.
    LeafDistances(const LeafBlocks& blocks, const Box& indexBox, float background);

    /// Whole cells that lie between the one of `voxel` and the nearest that holds anything below the background, along
    /// the axis that has most of them. 0 where nothing is known.
    int cellsBetween(const Vec3i& voxel) const
    {
        const Vec3i cell = voxel.unaryExpr([](int v) { return v >> BlockLayout::kLeafBits; }) - min_;
        if ((cell.array() < 0).any() || (cell.array() >= size_.array()).any()) return 0;
        return between_[placeOf(cell)];
    }

    std::size_t memoryBytes() const { return between_.size(); }

    static constexpr std::size_t kMostCells = std::size_t(1) << 21;

private:
    std::size_t placeOf(const Vec3i& cell) const
    {
        return (std::size_t(cell.x()) * std::size_t(size_.y()) + std::size_t(cell.y())) * std::size_t(size_.z()) +
               std::size_t(cell.z());
    }
    void spread(bool forward);

    Vec3i min_ = Vec3i::Zero(); // in leaves
    Vec3i size_ = Vec3i::Zero();
    std::vector<std::uint8_t> between_;
};

} // namespace vdbounce
