// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report.h"

/// @file
/// How reports tell the sides of a voxel, world units: one number for a cube, three for what is none.

namespace vdbounce::tool {

Json voxelJson(const Vec3d& sides);
std::string voxelText(const Vec3d& sides);

} // namespace vdbounce::tool
