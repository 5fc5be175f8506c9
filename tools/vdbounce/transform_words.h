// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report.h"

#include "vdbounce/field/linear_transform.h"

#include <string>

namespace vdbounce::tool {

/// How a grid's voxels lie in the world: "cubes of side 0.1 along the world's axes", "sides 0.1, 0.1, 0.2, turned by 30
/// degrees about (0, 1, 0)", and whether they are mirrored or sheared.
std::string transformWords(const LinearTransform& transform);

/// {sides, cubes, turned_deg, turned_about, mirrored, sheared, angles_deg (between axes y and z, z and x, x and y),
/// matrix (world = matrix * index + origin, by rows), origin, words}
Json transformJson(const LinearTransform& transform);

} // namespace vdbounce::tool
