// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/point_welding.h"

#include "vdbounce/build/disjoint_sets.h"

#include <cmath>
#include <cstring>
#include <unordered_map>

namespace vdbounce {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

std::uint64_t mix(std::uint64_t hash, std::uint64_t word)
{
    hash = (hash ^ word) * 0x9e3779b97f4a7c15ULL;
    return hash ^ (hash >> 29);
}

std::uint64_t hashOf(const Vec3d& p)
{
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double plain = p[axis] + 0.0; // minus zero becomes zero
        std::uint64_t bits;
        std::memcpy(&bits, &plain, sizeof(bits));
        hash = mix(hash, bits);
    }
    return hash;
}

std::uint64_t hashOfCell(std::int64_t x, std::int64_t y, std::int64_t z)
{
    return mix(mix(mix(0, std::uint64_t(x)), std::uint64_t(y)), std::uint64_t(z));
}

} // namespace

std::vector<std::uint32_t> weldEqual(const std::vector<Vec3d>& points)
{
    std::size_t slots = 16;
    while (slots < 2 * points.size()) slots *= 2;
    std::vector<std::uint32_t> table(slots, kNone);
    std::vector<std::uint32_t> first(points.size());
    for (std::uint32_t p = 0; p < points.size(); ++p) {
        std::size_t slot = hashOf(points[p]) & (slots - 1);
        while (table[slot] != kNone && points[table[slot]] != points[p]) slot = (slot + 1) & (slots - 1);
        if (table[slot] == kNone) table[slot] = p;
        first[p] = table[slot];
    }
    return first;
}

void weldClose(const std::vector<Vec3d>& points, const std::vector<char>& marked, double distance,
               std::vector<std::uint32_t>& pointOf)
{
    // Points of one cell of this size, or of neighbouring ones, may be close. Different cells that hash alike only
    // cost a comparison.
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells;
    const auto cellOf = [&](const Vec3d& p, int axis) { return std::int64_t(std::floor(p[axis] / distance)); };
    DisjointSets sets(points.size());
    for (std::uint32_t p = 0; p < points.size(); ++p) {
        if (marked[p] == 0 || pointOf[p] != p) continue;
        const Vec3d& at = points[p];
        for (int dx = -1; dx <= 1; ++dx) {
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dz = -1; dz <= 1; ++dz) {
                    const auto cell =
                        cells.find(hashOfCell(cellOf(at, 0) + dx, cellOf(at, 1) + dy, cellOf(at, 2) + dz));
                    if (cell == cells.end()) continue;
                    for (std::uint32_t other : cell->second) {
                        if ((points[other] - at).squaredNorm() < distance * distance) sets.join(other, p);
                    }
                }
            }
        }
        cells[hashOfCell(cellOf(at, 0), cellOf(at, 1), cellOf(at, 2))].push_back(p);
    }
    for (std::uint32_t& p : pointOf) p = sets.find(p);
}

} // namespace vdbounce
