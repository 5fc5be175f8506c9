// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"
#include "vdbounce/base/vector.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace vdbounce {

/// Points sorted into the cubic cells of a lattice, to find those near another. The same order for any number of
/// threads. Cost: a parallel sort of the points.
class CellList {
public:
    /// `cell` > 0 is the side of a cell, world units; points with `skipped` set are left out. A lattice of more than
    /// 2^20 cells an axis gets larger cells.
    CellList(const std::vector<Vec3d>& points, const std::vector<std::uint8_t>& skipped, double cell);

    /// The points that are not skipped, cell by cell; `place` counts them.
    std::size_t size() const { return entries_.size(); }
    std::uint32_t index(std::size_t place) const { return entries_[place].index; }

    /// The places of the first points of all cells that hold any, in order, and size().
    const std::vector<std::uint32_t>& cellBegins() const { return cellBegins_; }

    /// Which of 27 sets the cell of a point belongs to. Two cells of one set are so far apart that no cell is next to
    /// both.
    int colourOf(std::size_t place) const;

    /// Calls visit(index) for those points in the 27 cells around the one at `place` that come after it, in a fixed
    /// order. So each two points within a cell's side of each other are met once, and some more.
    template <class Visit> void forEachNearAfter(std::size_t place, const Visit& visit) const
    {
        const Vec3i middle = cellOf(entries_[place].key);
        for (int x = middle.x() - 1; x <= middle.x() + 1; ++x) {
            for (int y = middle.y() - 1; y <= middle.y() + 1; ++y) {
                if (x < 0 || y < 0 || x >= counts_.x() || y >= counts_.y()) continue;
                const int first = middle.z() > 0 ? middle.z() - 1 : 0;
                const int last = middle.z() + 1 < counts_.z() ? middle.z() + 1 : counts_.z() - 1;
                const std::size_t end = firstFrom(keyOf(Vec3i(x, y, last)) + 1);
                const std::size_t begin = firstFrom(keyOf(Vec3i(x, y, first)));
                for (std::size_t i = std::max(begin, place + 1); i < end; ++i) visit(entries_[i].index);
            }
        }
    }

private:
    struct Entry {
        std::uint64_t key;
        std::uint32_t index;
    };

    Vec3i cellOf(const Vec3d& position) const;
    Vec3i cellOf(std::uint64_t key) const;
    std::uint64_t keyOf(const Vec3i& cell) const
    {
        return (std::uint64_t(cell.x()) * std::uint64_t(counts_.y()) + std::uint64_t(cell.y())) *
                   std::uint64_t(counts_.z()) +
               std::uint64_t(cell.z());
    }
    /// The place of the first entry whose key is not below `key`.
    std::size_t firstFrom(std::uint64_t key) const;
    void buildStarts();

    Box box_;
    double cell_;
    Vec3i counts_ = Vec3i::Ones();
    std::vector<Entry> entries_;
    std::vector<std::uint32_t> cellBegins_;
    std::vector<std::uint32_t> starts_; // by cell, where there are few enough of them
};

} // namespace vdbounce
