// SPDX-License-Identifier: Apache-2.0
#include "voxel_text.h"

namespace vdbounce::tool {
namespace {

// Sides of a rotated cube differ by rounding.
constexpr double kSameSide = 1e-12;

bool isCube(const Vec3d& sides) { return sides.maxCoeff() - sides.minCoeff() <= kSameSide * sides.maxCoeff(); }

} // namespace

Json voxelJson(const Vec3d& sides) { return isCube(sides) ? Json(sides.x()) : toJson(sides); }
std::string voxelText(const Vec3d& sides) { return isCube(sides) ? rounded(sides.x()) : vectorText(sides); }

} // namespace vdbounce::tool
