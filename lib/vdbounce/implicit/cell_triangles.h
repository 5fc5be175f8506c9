// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/surface_patch.h"

namespace vdbounce {

/// Makes of `patch` the triangles of marching tetrahedra in a cell: six tetrahedra around the cell's diagonal, in each
/// the function is linear. They meet those of the cells beside without a gap, and on the cell's edges the surface is
/// where linear interpolation has it. Diagonals that are no edges of the tetrahedra add the points where their ends
/// have the surface, as triangles without size, where they may reach farther into a corner than the tetrahedra do.
/// `cell` points to the value at the cell's lowest corner in a SampleBlock.
void addTriangles(const float* cell, const VoxelMetric& metric, SurfacePatch& patch,
                  std::vector<PatchTriangle>& triangles);

/// The point of a triangle closest to p.
Eigen::Vector3f closestPoint(const PatchTriangle& triangle, const Eigen::Vector3f& p);

} // namespace vdbounce
