// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/io/triangle_mesh.h"

#include <vector>

namespace vdbounce {

/// Cuts a polygon, convex or not, into triangles and appends them to `mesh`. Corners index mesh.points and keep
/// their direction. Method: ear clipping in the plane of Newell's normal; where a polygon is so twisted that no ear
/// is left, the rest becomes a fan, so that it always yields corners.size() - 2 triangles.
void appendPolygon(TriangleMesh& mesh, const std::vector<std::uint32_t>& corners);

} // namespace vdbounce
