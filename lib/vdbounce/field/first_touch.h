// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/distance_field.h"

#include <optional>

namespace vdbounce {

/// How far along the straight path from `from` to `to` (world space, 0 to 1) phi first falls below `radius`: the last
/// place known to be free. Nothing where it never does.
///
/// In the grid's box, with Lookup::Trilinear, the path is followed from cell to cell, where phi is a cubic: not the
/// shortest dip is missed (see cubic_root.h). Cells whose values are all larger than the radius by a voxel and more are
/// passed over in strides that cannot reach a surface. Outside the box, and with the other lookups, the strides are
/// phi - radius over the field's Lipschitz bound, but at least a quarter of a voxel, so a dip shorter than that may be
/// missed there; a bracketed root is then halved down. Cost: some 20 nanoseconds a cell near the surface.
/// Method: lecture, slide 15; for cubics in cells, Parker et al. 1998.
std::optional<double> firstTouch(const DistanceField& field, const Vec3d& from, const Vec3d& to, double radius);

} // namespace vdbounce
