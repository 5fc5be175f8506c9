// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"
#include "vdbounce/field/linear_transform.h"

namespace vdbounce {

/// The closest point of an index-space box to an index-space point, closest by world distance: where the transform has
/// no shear that is a clamp, else the minimum over the faces, edges and corners of a parallelepiped.
Vec3d closestPointInBox(const Box& box, const Vec3d& index, const LinearTransform& transform);

} // namespace vdbounce
