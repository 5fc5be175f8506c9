// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/cell_list.h"

#include "vdbounce/base/parallel.h"

#include <algorithm>
#include <tuple>

#include <tbb/parallel_sort.h>

namespace vdbounce {
namespace {

constexpr std::size_t kPointsPerBlock = 16384;

// Cells along an axis at most, so that a key of three fits 64 bits.
constexpr double kMostCells = 1 << 20;

// A table over the cells is worth its memory up to this many for each point; beyond, places are searched for.
constexpr std::uint64_t kCellsPerPoint = 8;

} // namespace

CellList::CellList(const std::vector<Vec3d>& points, const std::vector<std::uint8_t>& skipped, double cell)
    : cell_(cell)
{
    std::size_t kept = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (skipped[i] != 0) continue;
        box_.add(points[i]);
        ++kept;
    }
    if (kept == 0) return;
    cell_ = std::max(cell_, box_.size().maxCoeff() / kMostCells);
    counts_ = (box_.size() / cell_).array().floor().min(kMostCells).cast<int>() + 1;
    entries_.resize(points.size());
    const std::uint64_t nowhere = ~std::uint64_t(0);
    forEachIndex(points.size(), kPointsPerBlock, [&](std::size_t i) {
        entries_[i] = {skipped[i] != 0 ? nowhere : keyOf(cellOf(points[i])), std::uint32_t(i)};
    });
    tbb::parallel_sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
        return std::tie(a.key, a.index) < std::tie(b.key, b.index);
    });
    entries_.resize(kept);
    for (std::size_t i = 0; i < kept; ++i) {
        if (i == 0 || entries_[i].key != entries_[i - 1].key) cellBegins_.push_back(std::uint32_t(i));
    }
    cellBegins_.push_back(std::uint32_t(kept));
    buildStarts();
}

void CellList::buildStarts()
{
    const std::uint64_t cells = keyOf(counts_ - Vec3i::Ones()) + 1;
    if (cells > kCellsPerPoint * entries_.size() + 4096) return;
    starts_.assign(cells + 1, std::uint32_t(entries_.size()));
    for (std::size_t i = entries_.size(); i-- > 0;) starts_[entries_[i].key] = std::uint32_t(i);
    // A cell without points begins where the next one does.
    for (std::size_t c = cells; c-- > 0;) starts_[c] = std::min(starts_[c], starts_[c + 1]);
}

Vec3i CellList::cellOf(const Vec3d& position) const
{
    const Vec3d cell = ((position - box_.min) / cell_).array().floor();
    return cell.cwiseMax(0.0).cwiseMin((counts_ - Vec3i::Ones()).cast<double>()).cast<int>();
}

Vec3i CellList::cellOf(std::uint64_t key) const
{
    const auto z = std::uint64_t(counts_.z());
    const auto y = std::uint64_t(counts_.y());
    return Vec3i(int(key / z / y), int(key / z % y), int(key % z));
}

int CellList::colourOf(std::size_t place) const
{
    const Vec3i cell = cellOf(entries_[place].key);
    return (cell.x() % 3 * 3 + cell.y() % 3) * 3 + cell.z() % 3;
}

std::size_t CellList::firstFrom(std::uint64_t key) const
{
    if (!starts_.empty()) return starts_[std::min<std::uint64_t>(key, starts_.size() - 1)];
    const auto first = std::lower_bound(entries_.begin(), entries_.end(), key,
                                        [](const Entry& entry, std::uint64_t k) { return entry.key < k; });
    return std::size_t(first - entries_.begin());
}

} // namespace vdbounce
