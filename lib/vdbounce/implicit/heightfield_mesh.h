// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/height_grid.h"
#include "vdbounce/io/triangle_mesh.h"

namespace vdbounce {

/// The surface of the solid whose distance HeightfieldField gives, world space: two triangles a cell, two for each step
/// along the border's walls, and a fan of as many as the border has steps for the bottom. Closed, manifold and facing
/// outwards; rounded to the precision of world coordinates.
///
/// Throws what placeHeightMap() throws, and UsageError for maps of more than 2^31 cells, whose triangles no mesh can
/// count.
TriangleMesh heightfieldMesh(const HeightMap& map, const HeightfieldOptions& options);

} // namespace vdbounce
