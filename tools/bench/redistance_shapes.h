// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"
#include "vdbounce/io/scalar_grid.h"

#include <functional>
#include <string>
#include <vector>

/// @file
/// Shapes of about unit size with exact distances, and level sets of them that lost their unit gradient.

namespace vdbounce::bench {

struct RedistanceShape {
    std::string name;
    std::function<double(const Vec3d&)> phi; ///< exact, world units

    /// Within this distance of an edge, world units: false. True for shapes without edges.
    std::function<bool(const Vec3d&, double)> awayFromEdges;
};

RedistanceShape unitSphere();

/// Radii 0.8 and 0.3.
RedistanceShape unitTorus();

/// Zalesak's slotted disc (1979), a unit high: a cylinder of radius 1 with a slot a third wide and reaching up to y =
/// 2/3.
RedistanceShape slottedDisc();

/// What the values are to be, given the distance and the point; zero where the distance is.
struct Distortion {
    std::string name;
    std::function<double(double, const Vec3d&)> value;
};
std::vector<Distortion> distortions(); ///< the first leaves the distance alone

/// A level set of half width 3 voxels whose active values are distorted.
ScalarGrid distortedLevelSet(const RedistanceShape& shape, const Distortion& distortion, double voxelSize);

} // namespace vdbounce::bench
