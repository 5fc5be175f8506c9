// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace vdbounce {

/// An implicit function F at the voxel centres of an 8^3 leaf and around it, as many as cubic interpolation needs in
/// all cells whose lowest corner lies in the leaf: from offset -1 to 9 along each axis. F < 0 inside, F = 0 at the
/// surface.
struct SampleBlock {
    static constexpr int kLow = -1;
    static constexpr int kSide = 11;
    static constexpr int kStrideX = kSide * 12; ///< rows along z are padded to 12
    static constexpr int kStrideY = 12;
    static constexpr int kStrideZ = 1;

    std::array<float, kSide * kStrideX> value;

    /// Bit z + 1 of row (x, y): F is given there. Where it is not, `value` tells inside from outside and no more.
    std::array<std::uint16_t, kSide * kSide> known;
    bool allKnown = true;

    /// The place in `value` of an offset from the leaf's first voxel.
    static constexpr int at(int x, int y, int z) { return (x - kLow) * kStrideX + (y - kLow) * kStrideY + (z - kLow); }
    static constexpr int row(int x, int y) { return (x - kLow) * kSide + (y - kLow); }
};

} // namespace vdbounce
