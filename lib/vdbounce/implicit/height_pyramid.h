// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/height_grid.h"

#include <cstddef>
#include <vector>

namespace vdbounce {

/// The lowest and highest heights of squares of a grid's cells, whose sides double from level to level: a node of level
/// l holds up to 2^l cells a side. Level 0 is read off the samples. Memory: some five bytes a sample.
class HeightPyramid {
public:
    struct Range {
        double low;
        double high;
    };

    explicit HeightPyramid(const HeightGrid& grid);

    /// The lowest level that has one node.
    int top() const { return static_cast<int>(levels_.size()); }

    /// Of level 1 or above.
    const Range& range(int level, int column, int row) const
    {
        const Level& l = levels_[std::size_t(level - 1)];
        return l.nodes[std::size_t(row) * std::size_t(l.columns) + std::size_t(column)];
    }

    static Range cellRange(const HeightGrid& grid, int column, int row)
    {
        const double* a = grid.at(column, row);
        const double* b = a + grid.columns;
        return {std::min(std::min(a[0], a[1]), std::min(b[0], b[1])),
                std::max(std::max(a[0], a[1]), std::max(b[0], b[1]))};
    }

private:
    struct Level {
        int columns;
        int rows;
        std::vector<Range> nodes;
    };

    std::vector<Level> levels_; // from level 1
};

} // namespace vdbounce
