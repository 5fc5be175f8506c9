// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/build/band_leaves.h"

/// @file
/// Lists of leaves as bodies. All are in lexicographic order, before and after.

namespace vdbounce {

/// A leaf of which nothing is in the band; with room for triangles where `wantTriangles`.
std::unique_ptr<BandLeaf> emptyLeaf(const Vec3i& leaf, bool wantTriangles);

/// Adds `more`, none of which may be among `leaves`.
void addLeaves(BandLeaves more, BandLeaves& leaves);

/// Adds to `leaves` empty ones where `others` has some and it has none: what is near them is not known, but whether
/// they are inside can be told.
void addMissingLeaves(const BandLeaves& others, BandLeaves& leaves);

/// Makes distances to a sheet those to a body of twice the half thickness (world units).
void thicken(BandLeaves& leaves, float halfThickness);

/// The union of two bodies: the lesser distance at each voxel. Every leaf of `others`, which are let go, must be among
/// `leaves`.
void unite(BandLeaves& leaves, BandLeaves& others);

} // namespace vdbounce
