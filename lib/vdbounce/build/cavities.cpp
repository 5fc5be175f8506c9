// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/base/parallel.h"
#include "vdbounce/build/column_counts.h"
#include "vdbounce/build/solid_groups.h"

#include <array>
#include <unordered_map>

namespace vdbounce {
namespace {

constexpr std::size_t kColumnsPerTask = 64;

// How many crossings each group has, and how many of them lie within each other group.
struct Nesting {
    std::unordered_map<std::uint32_t, std::uint64_t> crossings;
    std::unordered_map<std::uint64_t, std::uint64_t> within; // inner group << 32 | outer group

    Nesting& operator+=(const Nesting& other)
    {
        for (const auto& [group, count] : other.crossings) crossings[group] += count;
        for (const auto& [pair, count] : other.within) within[pair] += count;
        return *this;
    }
};

// A crossing is within a group that winds around it from just below to just above. Crossings of a column come
// upwards; those at the same height count as one.
void followColumn(const std::vector<SolidGroup>& groups, const std::vector<const Crossing*>& column, Nesting& nesting)
{
    ColumnCounts counts;
    for (std::size_t i = 0; i < column.size();) {
        std::size_t end = i + 1;
        while (end < column.size() && column[end]->z == column[i]->z) ++end;
        const std::vector<ColumnCounts::Count> before = counts.all();
        for (std::size_t j = i; j < end; ++j) counts.add(column[j]->group, column[j]->change);
        for (std::size_t j = i; j < end; ++j) {
            const std::uint32_t group = column[j]->group;
            ++nesting.crossings[group];
            for (const auto& [outer, count] : before) {
                if (outer != group && groups[outer].holds(count) && groups[outer].holds(counts.of(outer)))
                    ++nesting.within[(std::uint64_t(group) << 32) | outer];
            }
        }
        i = end;
    }
}

Nesting findNesting(const SolidGroups& solids, const std::vector<Crossing>& crossings)
{
    const std::vector<std::size_t> begins = leafColumnBegins(crossings);
    return reduceBlocks(begins.size() - 1, kColumnsPerTask, Nesting{}, [&](IndexRange range) {
        Nesting nesting;
        std::array<std::vector<const Crossing*>, 64> columns;
        for (std::size_t leafColumn = range.begin; leafColumn < range.end; ++leafColumn) {
            for (auto& column : columns) column.clear();
            for (std::size_t i = begins[leafColumn]; i < begins[leafColumn + 1]; ++i)
                columns[std::size_t(crossings[i].column)].push_back(&crossings[i]);
            for (const auto& column : columns) followColumn(solids.groups, column, nesting);
        }
        return nesting;
    });
}

// The same voxels, their columns along another axis.
LinearTransform turned(const LinearTransform& transform, int axis)
{
    Mat3d columns;
    for (int to = 0; to < 3; ++to) columns.col(to) = transform.indexToWorld().col((to + axis + 1) % 3);
    return LinearTransform(columns, transform.origin());
}

struct Places {
    std::vector<std::uint32_t> around; // how many others each group lies wholly within
    std::vector<char> cuts;            // whether it lies in part within one
    std::vector<char> inwards;         // whether it faces inwards, where most of the mesh faces outwards

    Places(const std::vector<SolidGroup>& groups, const Nesting& nesting)
        : around(groups.size(), 0), cuts(groups.size(), 0), inwards(groups.size(), 0)
    {
        for (const auto& [pair, count] : nesting.within) {
            const auto inner = static_cast<std::uint32_t>(pair >> 32);
            if (count == nesting.crossings.at(inner)) {
                ++around[inner];
            } else {
                cuts[inner] = 1;
            }
        }
        double volume = 0.0;
        for (std::size_t g = 0; g < groups.size(); ++g) volume += around[g] == 0 ? groups[g].volume : 0.0;
        // A mesh that is inside out as a whole is turned as a whole.
        const double outwards = volume < 0.0 ? -1.0 : 1.0;
        for (std::size_t g = 0; g < groups.size(); ++g) inwards[g] = groups[g].volume * outwards < 0.0 ? 1 : 0;
    }

    bool sameWay(std::size_t g) const { return around[g] % 2 == 1 && inwards[g] == 0; }
    std::size_t countSameWay() const
    {
        std::size_t count = 0;
        for (std::size_t g = 0; g < around.size(); ++g) count += sameWay(g) ? 1 : 0;
        return count;
    }
};

} // namespace

std::size_t findCavities(SolidGroups& solids, const std::vector<Crossing>& crossings, const LinearTransform& transform,
                         const Progress& progress)
{
    auto& groups = solids.groups;
    if (groups.size() < 2) return 0;
    Nesting nesting = findNesting(solids, crossings);
    Places places(groups, nesting);
    if (places.countSameWay() > 0) {
        // Columns along one axis do not see what touches or sticks out along another.
        for (int axis = 0; axis < 2; ++axis) {
            throwIfStopped(progress);
            nesting += findNesting(solids, findCrossings(solids.mesh, turned(transform, axis), progress));
        }
        places = Places(groups, nesting);
    }
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const bool odd = places.around[g] % 2 == 1;
        if (odd || (places.inwards[g] != 0 && places.cuts[g] != 0 && places.around[g] == 0)) groups[g].weight = -1;
    }
    return places.countSameWay();
}

} // namespace vdbounce
