// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/point_welding.h"

#include "vdbounce/base/disjoint_sets.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace vdbounce {
namespace {

std::uint64_t mix(std::uint64_t hash, std::uint64_t word)
{
    hash = (hash ^ word) * 0x9e3779b97f4a7c15ULL;
    return hash ^ (hash >> 29);
}

std::uint64_t hashOfCell(std::int64_t x, std::int64_t y, std::int64_t z)
{
    return mix(mix(mix(0, std::uint64_t(x)), std::uint64_t(y)), std::uint64_t(z));
}

// Points by cells of one size. Different cells that hash alike only cost a comparison.
class CellTable {
public:
    explicit CellTable(double side) : side_(side) {}

    void add(std::uint32_t point, const Vec3d& at)
    {
        cells_[hashOfCell(cellOf(at.x()), cellOf(at.y()), cellOf(at.z()))].push_back(point);
    }

    /// Calls visit(point) for the points of all cells that a box around `at` touches.
    template <class Visit> void forEachNear(const Vec3d& at, double reach, const Visit& visit) const
    {
        for (std::int64_t x = cellOf(at.x() - reach); x <= cellOf(at.x() + reach); ++x) {
            for (std::int64_t y = cellOf(at.y() - reach); y <= cellOf(at.y() + reach); ++y) {
                for (std::int64_t z = cellOf(at.z() - reach); z <= cellOf(at.z() + reach); ++z) {
                    const auto cell = cells_.find(hashOfCell(x, y, z));
                    if (cell != cells_.end()) std::for_each(cell->second.begin(), cell->second.end(), visit);
                }
            }
        }
    }

private:
    std::int64_t cellOf(double coordinate) const { return std::int64_t(std::floor(coordinate / side_)); }

    double side_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

// Reaches are told apart by powers of two of the largest, down to this one; closer is the same.
constexpr int kLevels = 40;

} // namespace

void weldClose(const std::vector<Vec3d>& points, const std::vector<double>& reach, std::vector<std::uint32_t>& pointOf)
{
    const double longest = reach.empty() ? 0.0 : *std::max_element(reach.begin(), reach.end());
    if (!(longest > 0.0)) return;
    // Those that reach far come first, each by cells of the size of its reach: whatever comes later is seldom near
    // many.
    std::vector<std::vector<std::uint32_t>> byLevel(kLevels);
    for (std::uint32_t p = 0; p < points.size(); ++p) {
        if (!(reach[p] > 0.0) || pointOf[p] != p) continue;
        const int level = int(std::floor(std::log2(longest / reach[p])));
        if (level < kLevels) byLevel[std::size_t(level)].push_back(p);
    }
    std::vector<CellTable> tables;
    DisjointSets sets(points.size());
    for (std::size_t level = 0; level < byLevel.size(); ++level) {
        tables.emplace_back(std::ldexp(longest, -int(level)));
        for (std::uint32_t p : byLevel[level]) {
            for (std::size_t farther = 0; farther <= level; ++farther) {
                if (byLevel[farther].empty()) continue;
                tables[farther].forEachNear(points[p], reach[p], [&](std::uint32_t other) {
                    const double close = std::min(reach[p], reach[other]);
                    if ((points[other] - points[p]).squaredNorm() < close * close) sets.join(other, p);
                });
            }
            tables[level].add(p, points[p]);
        }
    }
    for (std::uint32_t& p : pointOf) p = sets.find(p);
}

} // namespace vdbounce
