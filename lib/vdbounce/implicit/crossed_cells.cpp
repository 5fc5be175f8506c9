// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/crossed_cells.h"

namespace vdbounce {
namespace {

using Bits = std::uint32_t;

struct Signs {
    Bits row[SampleBlock::kSide * SampleBlock::kSide];

    explicit Signs(const SampleBlock& block)
    {
        for (int r = 0; r < SampleBlock::kSide * SampleBlock::kSide; ++r) {
            const float* values = block.value.data() + r * SampleBlock::kStrideY;
            row[r] = 0;
            for (int z = 0; z < SampleBlock::kSide; ++z) row[r] |= Bits(values[z] < 0.0f ? 1 : 0) << z;
        }
    }
};

// In which cells of a row the sign changes on an edge with an end that is not known, given the four rows of corners.
Bits cutCells(const Bits (&s)[4], const Bits (&k)[4])
{
    Bits cut = 0;
    for (int i = 0; i < 4; ++i) cut |= (s[i] ^ s[i] >> 1) & ~(k[i] & k[i] >> 1);
    constexpr int kEdges[4][2] = {{0, 1}, {2, 3}, {0, 2}, {1, 3}};
    for (const auto& edge : kEdges) {
        const Bits bad = (s[edge[0]] ^ s[edge[1]]) & ~(k[edge[0]] & k[edge[1]]);
        cut |= bad | bad >> 1;
    }
    return cut;
}

} // namespace

CrossedCells::CrossedCells(const SampleBlock& block)
{
    const Signs signs(block);
    constexpr Bits kAll = (1 << kSide) - 1;
    for (int x = -1; x + 1 < kSide; ++x) {
        for (int y = -1; y + 1 < kSide; ++y) {
            Bits s[4];
            Bits k[4];
            for (int i = 0; i < 4; ++i) {
                const int row = SampleBlock::row(x + (i >> 1), y + (i & 1));
                s[i] = signs.row[row];
                k[i] = block.known[std::size_t(row)];
            }
            const Bits some = s[0] | s[1] | s[2] | s[3];
            const Bits all = s[0] & s[1] & s[2] & s[3];
            const Bits mixed = (some | some >> 1) & ~(all & all >> 1) & kAll;
            const Bits cut = mixed != 0 && !block.allKnown ? cutCells(s, k) & kAll : 0;
            crossed_[place(x, y)] = std::uint16_t(mixed & ~cut);
            cut_[place(x, y)] = std::uint16_t(cut);
            anyCut_ = anyCut_ || cut != 0;
            if (x >= 0 && x < 8 && y >= 0 && y < 8 && (crossed_[place(x, y)] & 0x1fe) != 0) any_ = true;
        }
    }
}

bool CrossedCells::besideCut(int x, int y, int z) const
{
    if (!anyCut_) return false;
    Bits cut = 0;
    for (int i = -1; i <= 1; ++i) {
        for (int j = -1; j <= 1; ++j) cut |= cut_[place(x + i, y + j)];
    }
    return (cut >> z & 7) != 0;
}

} // namespace vdbounce
