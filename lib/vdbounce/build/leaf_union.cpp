// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/leaf_union.h"

#include "vdbounce/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vdbounce {
namespace {

constexpr std::size_t kLeavesPerTask = 64;

bool comesBefore(const std::unique_ptr<BandLeaf>& a, const std::unique_ptr<BandLeaf>& b)
{
    return std::lexicographical_compare(a->leaf.data(), a->leaf.data() + 3, b->leaf.data(), b->leaf.data() + 3);
}

} // namespace

std::unique_ptr<BandLeaf> emptyLeaf(const Vec3i& leaf, bool wantTriangles)
{
    auto empty = std::make_unique<BandLeaf>();
    empty->leaf = leaf;
    empty->distance.fill(std::numeric_limits<float>::infinity());
    if (wantTriangles) {
        empty->triangle = std::make_unique<LeafArray<std::uint32_t>>();
        empty->triangle->fill(BandLeaf::kNoTriangle);
    }
    return empty;
}

void addLeaves(BandLeaves more, BandLeaves& leaves)
{
    const auto had = std::ptrdiff_t(leaves.size());
    std::sort(more.begin(), more.end(), comesBefore);
    std::move(more.begin(), more.end(), std::back_inserter(leaves));
    std::inplace_merge(leaves.begin(), leaves.begin() + had, leaves.end(), comesBefore);
}

void addMissingLeaves(const BandLeaves& others, BandLeaves& leaves)
{
    BandLeaves missing;
    for (const auto& other : others) {
        if (!std::binary_search(leaves.begin(), leaves.end(), other, comesBefore))
            missing.push_back(emptyLeaf(other->leaf, other->triangle != nullptr));
    }
    addLeaves(std::move(missing), leaves);
}

void thicken(BandLeaves& leaves, float halfThickness)
{
    // A voxel centre on the mesh itself is inside by the whole half thickness, and must count as inside the band.
    const float deepest = std::nextafter(-halfThickness, 0.0f);
    forEachIndex(leaves.size(), kLeavesPerTask, [&](std::size_t i) {
        for (float& distance : leaves[i]->distance) distance = std::max(distance - halfThickness, deepest);
    });
}

void unite(BandLeaves& leaves, BandLeaves& others)
{
    forEachIndex(others.size(), kLeavesPerTask, [&](std::size_t i) {
        const BandLeaf& other = *others[i];
        BandLeaf& leaf = **std::lower_bound(leaves.begin(), leaves.end(), others[i], comesBefore);
        for (std::size_t v = 0; v < leaf.distance.size(); ++v) {
            if (!(other.distance[v] < leaf.distance[v])) continue;
            leaf.distance[v] = other.distance[v];
            if (leaf.triangle != nullptr) (*leaf.triangle)[v] = (*other.triangle)[v];
        }
    });
    others.clear();
}

} // namespace vdbounce
