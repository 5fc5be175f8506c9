// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/vector_lookup.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vdbounce {

/// Points by groups of neighbouring blocks, so that the voxels of one group stay in the cache while its points are
/// looked up.
class BlockOrder {
public:
    /// Points that are ordered together at most: their numbers take 24 MiB.
    static constexpr std::size_t kMostPoints = std::size_t(1) << 22;

    /// Whether ordering would pay: it does not where the points come in order already, where few of them lie in
    /// blocks, where there are too few of them to share what a group brings into the cache, and where all voxels fit
    /// there. Looks at some of the points.
    static bool pays(const VectorField& field, std::size_t blockCount, const Vec3d* points, std::size_t count);

    /// The numbers of up to kMostPoints points, group by group, those outside of all blocks first. In parallel; the
    /// same for any number of threads.
    const std::vector<std::uint32_t>& order(const VectorField& field, std::size_t blockCount, const Vec3d* points,
                                            std::size_t count);

private:
    std::vector<std::uint16_t> groups_; // of each point
    std::vector<std::uint32_t> places_; // for each task and group, where its next point goes
    std::vector<std::uint32_t> order_;
};

} // namespace vdbounce
