// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/grids.h"

#include "vdbounce/field/distance_field.h"

#include <memory>

namespace vdbounce::test {

using FieldPtr = std::shared_ptr<const DistanceField>;

/// The level set that bandGrid() makes of `phi`, for lookup.
inline FieldPtr fieldOf(const Phi& phi, const openvdb::math::Transform::Ptr& transform, int side,
                        double halfWidthVx = 3.0)
{
    return std::make_shared<const DistanceField>(levelSet(bandGrid(phi, transform, side, halfWidthVx)));
}

/// With cubes of `voxel` world units.
inline FieldPtr fieldOf(const Phi& phi, double voxel, int side, double halfWidthVx = 3.0)
{
    return fieldOf(phi, uniformTransform(voxel), side, halfWidthVx);
}

} // namespace vdbounce::test
