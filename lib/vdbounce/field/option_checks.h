// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

/// @file
/// What several ways to make grids ask of their options. Each throws UsageError, which names the option and the value.

namespace vdbounce {

/// Refuses `value` of the option `name` unless `good`: "NAME: VALUE is out of range; REMEDY".
void requireInRange(bool good, const char* name, double value, const std::string& remedy);

/// Refuses a voxel whose shortest side, world units, is no length above 0 or less than OpenVDB's transforms hold.
/// `subject` is what would then have to be larger, "mesh".
void requireVoxelSize(double voxel, const std::string& subject);

/// Refuses a half width of a band, voxels, that is less than one or beyond any grid.
void requireBand(const char* name, double halfWidthVx);

/// Refuses `voxel`, its shortest side in world units, for what reaches so far that coordinates do not hold it:
/// `farthest`, voxels from the origin. `subject` and `it` name it in the message: "a mesh that", "the mesh".
[[noreturn]] void refuseFarVoxels(double voxel, double farthest, const std::string& subject, const std::string& it);

} // namespace vdbounce
