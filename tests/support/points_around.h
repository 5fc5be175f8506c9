// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/random.h"

#include "vdbounce/field/distance_field.h"

#include <vector>

namespace vdbounce::test {

/// The grid's box and three voxels around it, index space.
inline Box boxAround(const DistanceField& field)
{
    Box box = field.indexBox();
    box.min -= Vec3d::Constant(3.0);
    box.max += Vec3d::Constant(3.0);
    return box;
}

/// In the band, in tiles, and outside of the grid's box.
inline std::vector<Vec3d> pointsAround(const DistanceField& field, Random& random, std::size_t count)
{
    const Box box = boxAround(field);
    std::vector<Vec3d> points;
    while (points.size() < count) points.push_back(field.transform().toWorld(random.in(box)));
    return points;
}

} // namespace vdbounce::test
