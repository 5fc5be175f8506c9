// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/height_surface.h"

#include <cmath>

namespace vdbounce {
namespace {

// The rounding of distances, relative to them and to the map's size; machine epsilon times the few operations that
// each takes, and room. What is not farther by more than this is looked at, so that the least of all computed distances
// is found in whatever order they are computed.
constexpr double kRounding = 1e-13;

// As many cells within reach are looked at one by one: for so few the pyramid costs more than it saves.
constexpr int kFewCells = 20;

// After as few steps down the slope the nearest cell is found on all but rough terrain.
constexpr int kHops = 4;

// Levels of a pyramid over an int of cells, three brothers waiting on each and four nodes to begin with.
constexpr int kStackSize = 4 + 3 * 32;

double outside(double x, double low, double high) { return std::max(0.0, std::max(low - x, x - high)); }

} // namespace

HeightCell HeightSurface::cell(Cell at) const
{
    const double* h = grid_.at(at.column, at.row);
    const double* next = h + grid_.columns;
    return {grid_.stepX, grid_.stepZ, h[1] - h[0], next[1] - h[0], next[0] - h[0]};
}

Vec3d HeightSurface::corner(Cell at) const
{
    return Vec3d(at.column * grid_.stepX, *grid_.at(at.column, at.row), at.row * grid_.stepZ);
}

/// One point's way to its nearest cell.
class HeightSurface::Search {
public:
    Search(const HeightSurface& surface, const Vec3d& p, Nearest& best)
        : surface_(surface), grid_(surface.grid_), pyramid_(surface.pyramid_), p_(p), best_(best),
          rounding_(kRounding * (grid_.sizeX() + grid_.sizeZ() + (grid_.highest - grid_.base) + p.cwiseAbs().sum()))
    {
        limit();
    }

    void run(Cell start)
    {
        tryCell(start);
        followSlope(start);
        const int left = grid_.cellX(p_.x() - reach_);
        const int right = grid_.cellX(p_.x() + reach_);
        const int front = grid_.cellZ(p_.z() - reach_);
        const int back = grid_.cellZ(p_.z() + reach_);
        if (double(right - left + 1) * double(back - front + 1) <= kFewCells) {
            for (int row = front; row <= back; ++row) {
                for (int column = left; column <= right; ++column) {
                    if (column == start.column && row == start.row) continue;
                    if (distance2(0, column, row) <= limit2_) tryCell({column, row});
                }
            }
            return;
        }
        int level = 0;
        while (((right >> level) - (left >> level)) > 1 || ((back >> level) - (front >> level)) > 1) ++level;
        push(level, left >> level, right >> level, front >> level, back >> level);
        descend();
    }

private:
    struct Node {
        double distance2;
        int level;
        int column;
        int row;
    };

    void limit()
    {
        reach_ = std::sqrt(best_.distance2) + rounding_;
        limit2_ = reach_ * reach_;
    }

    // True if it is the nearest so far.
    bool tryCell(Cell cell)
    {
        const HeightCellNearest found = surface_.cell(cell).nearest(p_ - surface_.corner(cell), limit2_);
        if (found.distance2 >= best_.distance2) return false;
        best_ = {found.distance2, cell, found.part};
        limit();
        return true;
    }

    // Down or up the slope to where the surface is nearer than right below: the closer the first guess, the fewer cells
    // are within its reach.
    void followSlope(Cell cell)
    {
        for (int hop = 0; hop < kHops; ++hop) {
            const Vec3d corner = surface_.corner(cell);
            const Cell next = surface_.cellAt(corner + surface_.cell(cell).foot(p_ - corner));
            if ((next.column == cell.column && next.row == cell.row) || !tryCell(next)) return;
            cell = next;
        }
    }

    // To the box around a node.
    double distance2(int level, int column, int row) const
    {
        const HeightPyramid::Range range =
            level == 0 ? HeightPyramid::cellRange(grid_, column, row) : pyramid_.range(level, column, row);
        const double side = 1 << level;
        const double endColumn = std::min((column + 1) * side, grid_.columns - 1.0);
        const double endRow = std::min((row + 1) * side, grid_.rows - 1.0);
        const double x = outside(p_.x(), column * side * grid_.stepX, endColumn * grid_.stepX);
        const double z = outside(p_.z(), row * side * grid_.stepZ, endRow * grid_.stepZ);
        const double y = outside(p_.y(), range.low, range.high);
        return x * x + y * y + z * z;
    }

    // Puts up to four nodes on the stack that are near enough, the nearest on top.
    void push(int level, int left, int right, int front, int back)
    {
        const int bottom = size_;
        for (int row = front; row <= back; ++row) {
            for (int column = left; column <= right; ++column) {
                const Node node{distance2(level, column, row), level, column, row};
                if (!(node.distance2 <= limit2_)) continue;
                int place = size_++;
                for (; place > bottom && stack_[place - 1].distance2 < node.distance2; --place) {
                    stack_[place] = stack_[place - 1];
                }
                stack_[place] = node;
            }
        }
    }

    void descend()
    {
        while (size_ > 0) {
            const Node node = stack_[--size_];
            if (!(node.distance2 <= limit2_)) continue;
            if (node.level == 0) {
                tryCell({node.column, node.row});
                continue;
            }
            const int below = node.level - 1;
            const int lastColumn = (grid_.columns - 2) >> below;
            const int lastRow = (grid_.rows - 2) >> below;
            push(below, 2 * node.column, std::min(2 * node.column + 1, lastColumn), 2 * node.row,
                 std::min(2 * node.row + 1, lastRow));
        }
    }

    const HeightSurface& surface_;
    const HeightGrid& grid_;
    const HeightPyramid& pyramid_;
    const Vec3d p_;
    Nearest& best_;
    const double rounding_;
    double reach_;
    double limit2_;
    Node stack_[kStackSize];
    int size_ = 0;
};

void HeightSurface::improve(Nearest& best, const Vec3d& p, Cell start) const { Search(*this, p, best).run(start); }

} // namespace vdbounce
