// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/sample_points.h"
#include "vdbounce/io/level_set_grid.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace vdbounce::bench {

/// Another way to look up phi and its gradient at many points, on the calling thread.
struct FieldPeer {
    std::string name;
    std::function<void(const Vec3d* points, std::size_t count, PointSample* samples)> lookUp;
    bool sameGradient; ///< interpolated central differences, as ours; else another and cheaper gradient
};

/// What a user would take instead, each at its best: OpenVDB with 7 box samples (phi and one voxel to either side along
/// each axis), its BoxStencil (gradient of the cell) and a gradient grid made beforehand, all through accessors that
/// cache the last leaf and are not registered with the tree; NanoVDB with 7 trilinear samples through its cached
/// accessor.
std::vector<FieldPeer> fieldPeers(const LevelSetGrid& grid);

} // namespace vdbounce::bench
