// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/build/mesh_topology.h"

#include <cstdint>
#include <vector>

namespace vdbounce {

/// A closed way along a component's rim that meets no point twice: the rim of a hole.
struct RimLoop {
    std::uint32_t component;
    std::vector<std::uint32_t> points; ///< in the direction in which its triangles run along the rim
};

/// Takes a topology's rim apart into loops. Rims always close, since triangles do.
std::vector<RimLoop> findRimLoops(const MeshTopology& topology);

/// Length of a loop, and its area were it a circle: no flat hole of that length is larger. World units.
double loopLength(const RimLoop& loop, const std::vector<Vec3d>& points);
double circleArea(const RimLoop& loop, const std::vector<Vec3d>& points);

} // namespace vdbounce
