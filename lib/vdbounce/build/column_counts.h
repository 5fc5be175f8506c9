// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/build/column_crossings.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace vdbounce {

/// How often each group winds around a point on its way up a column: what crossings have added up to so far.
class ColumnCounts {
public:
    struct Count {
        std::uint32_t group;
        int count; ///< never zero
    };

    int of(std::uint32_t group) const
    {
        for (const Count& entry : counts_) {
            if (entry.group == group) return entry.count;
        }
        return 0;
    }

    /// Adds to a group's count; returns what it was before and is now.
    std::pair<int, int> add(std::uint32_t group, int change)
    {
        for (Count& entry : counts_) {
            if (entry.group != group) continue;
            const int before = entry.count;
            entry.count += change;
            const int after = entry.count;
            if (after == 0) {
                entry = counts_.back();
                counts_.pop_back();
            }
            return {before, after};
        }
        counts_.push_back({group, change});
        return {0, change};
    }

    /// Those that are not zero, in no particular order.
    const std::vector<Count>& all() const { return counts_; }

    void clear() { counts_.clear(); }

private:
    std::vector<Count> counts_; // few are around any point
};

/// Where each leaf column's crossings begin, and the end of all.
inline std::vector<std::size_t> leafColumnBegins(const std::vector<Crossing>& crossings)
{
    std::vector<std::size_t> begins;
    for (std::size_t i = 0; i < crossings.size(); ++i) {
        if (i == 0 || !crossings[i].sameLeafColumn(crossings[i - 1])) begins.push_back(i);
    }
    begins.push_back(crossings.size());
    return begins;
}

} // namespace vdbounce
