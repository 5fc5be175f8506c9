// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/sample_block.h"

namespace vdbounce {

/// Which cells of a block the surface crosses, and where it is cut off. A cell is named by its lowest corner.
class CrossedCells {
public:
    explicit CrossedCells(const SampleBlock& block);

    /// Some cell of the leaf (0 to 7 along each axis) is crossed.
    bool any() const { return any_; }

    /// The sign changes between the cell's corners, and on no edge with an end that is not known.
    bool crossed(int x, int y, int z) const { return (crossed_[place(x, y)] >> (z + 1) & 1) != 0; }

    /// Between the corners of a cell that shares a corner with this one the sign changes on an edge with an end that is
    /// not known.
    bool besideCut(int x, int y, int z) const;

private:
    static constexpr int kSide = SampleBlock::kSide - 1;
    static std::size_t place(int x, int y) { return std::size_t((x + 1) * kSide + (y + 1)); }

    // Bit z + 1 of a row of cells.
    std::uint16_t crossed_[kSide * kSide];
    std::uint16_t cut_[kSide * kSide];
    bool any_ = false;
    bool anyCut_ = false;
};

} // namespace vdbounce
