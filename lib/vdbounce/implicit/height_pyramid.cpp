// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/height_pyramid.h"

#include "vdbounce/base/parallel.h"

namespace vdbounce {
namespace {

constexpr std::size_t kRowsPerBlock = 8; // of nodes; some thousands of them

} // namespace

HeightPyramid::HeightPyramid(const HeightGrid& grid)
{
    int columns = grid.columns - 1;
    int rows = grid.rows - 1;
    for (int level = 1; columns > 1 || rows > 1; ++level) {
        const int columnsBelow = columns;
        const int rowsBelow = rows;
        columns = (columns + 1) / 2;
        rows = (rows + 1) / 2;
        Level made{columns, rows, std::vector<Range>(std::size_t(columns) * std::size_t(rows))};
        forEachIndex(std::size_t(rows), kRowsPerBlock, [&](std::size_t row) {
            for (int column = 0; column < columns; ++column) {
                Range range{grid.highest, grid.lowest};
                for (int j = 2 * int(row); j < std::min(2 * int(row) + 2, rowsBelow); ++j) {
                    for (int i = 2 * column; i < std::min(2 * column + 2, columnsBelow); ++i) {
                        const Range part = level == 1 ? cellRange(grid, i, j) : this->range(level - 1, i, j);
                        range.low = std::min(range.low, part.low);
                        range.high = std::max(range.high, part.high);
                    }
                }
                made.nodes[row * std::size_t(columns) + std::size_t(column)] = range;
            }
        });
        levels_.push_back(std::move(made));
    }
}

} // namespace vdbounce
