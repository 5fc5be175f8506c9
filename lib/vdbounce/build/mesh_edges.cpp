// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/mesh_edges.h"

#include "vdbounce/base/parallel.h"

#include <algorithm>

namespace vdbounce {
namespace {

constexpr std::size_t kPointsPerTask = 4096;

} // namespace

MeshEdges::MeshEdges(const std::vector<TriangleMesh::Triangle>& triangles, std::size_t pointCount,
                     const std::vector<char>& use)
    : begin_(pointCount + 2)
{
    const auto forEachSide = [&](const auto& body) {
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            if (use[t] == 0) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = triangles[t][k];
                const std::uint32_t b = triangles[t][(k + 1) % 3];
                body(std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(3 * t + k));
            }
        }
    };
    // Counted one place further on, so that filling them moves each begin to where it belongs.
    forEachSide([&](std::uint32_t low, std::uint32_t, std::uint32_t) { ++begin_[low + 2]; });
    for (std::size_t p = 2; p < begin_.size(); ++p) begin_[p] += begin_[p - 1];
    sides_.resize(begin_.back());
    forEachSide([&](std::uint32_t low, std::uint32_t high, std::uint32_t side) {
        sides_[begin_[low + 1]++] = {high, side};
    });
    begin_.pop_back();
    forEachIndex(pointCount, kPointsPerTask, [&](std::size_t p) {
        std::sort(sides_.begin() + begin_[p], sides_.begin() + begin_[p + 1],
                  [](const Side& a, const Side& b) { return a.high != b.high ? a.high < b.high : a.side < b.side; });
    });
}

} // namespace vdbounce
