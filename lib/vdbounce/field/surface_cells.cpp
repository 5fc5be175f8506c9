// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/surface_cells.h"

#include <algorithm>

namespace vdbounce {
namespace {

bool crosses(const float* v, float level)
{
    constexpr int kX = BlockLayout::kStrideX;
    constexpr int kY = BlockLayout::kStrideY;
    const auto [low, high] = std::minmax({v[0], v[1], v[kY], v[kY + 1], v[kX], v[kX + 1], v[kX + kY], v[kX + kY + 1]});
    return low < level && high >= level;
}

} // namespace

std::vector<Vec3i> cellsAroundLevel(const DistanceField& field, double level)
{
    const LeafBlocks& blocks = field.blocks();
    std::vector<Vec3i> cells;
    float block[BlockLayout::kSize];
    for (std::size_t b = 0; b < blocks.blockCount(); ++b) {
        blocks.values().decode(b, block);
        const float* values = block + BlockLayout::kDiagonal;
        for (int x = 0; x < BlockLayout::kLeafSide; ++x) {
            for (int y = 0; y < BlockLayout::kLeafSide; ++y) {
                for (int z = 0; z < BlockLayout::kLeafSide; ++z) {
                    const float* v = values + x * BlockLayout::kStrideX + y * BlockLayout::kStrideY + z;
                    if (crosses(v, float(level))) cells.push_back(blocks.origins()[b] + Vec3i(x, y, z));
                }
            }
        }
    }
    return cells;
}

} // namespace vdbounce
