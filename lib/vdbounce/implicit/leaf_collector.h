// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"
#include "vdbounce/implicit/ball_descent.h"
#include "vdbounce/io/level_set_grid.h"

#include <cstdint>
#include <memory>
#include <string>

namespace vdbounce {

/// Takes the leaves of a level set, from many threads and in any order, and makes a grid of them.
class LeafCollector {
public:
    /// Refuses more leaves than that with UsageError.
    explicit LeafCollector(std::uint64_t maxLeaves);
    ~LeafCollector();
    LeafCollector(const LeafCollector&) = delete;
    LeafCollector& operator=(const LeafCollector&) = delete;

    /// A leaf (leaf coordinates): 512 values, z fastest, world units, and a bit for each that is active, 64 for each x.
    /// Each leaf may come once.
    void add(const Vec3i& leaf, const float* values, const std::uint64_t (&active)[8]);

    /// A cube that is inside beyond the band as a whole.
    void addInside(const LeafCube& cube);

    /// What came so far, once; nothing is left. `background` is the band's half width, world units; voxel centres lie
    /// at multiples of `voxelSize`.
    LevelSetGrid levelSet(float background, double voxelSize, const std::string& name);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
    std::uint64_t maxLeaves_;
};

} // namespace vdbounce
