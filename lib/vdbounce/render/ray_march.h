// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/distance_field.h"

#include <optional>

namespace vdbounce {

/// The first t in [begin, end] at which origin + t direction is on the field's surface, coming from outside;
/// `direction` need not have unit length. Method: sphere tracing (Hart 1996) with the field's Lipschitz bound.
std::optional<double> marchToSurface(const DistanceField& field, const Vec3d& origin, const Vec3d& direction,
                                     double begin, double end);

/// How much of a light in direction `towardsLight` (unit) reaches `point`: 1 all, 0 none, between where the field comes
/// close to the ray (Quilez: soft shadows of distance fields).
double lightReaching(const DistanceField& field, const Vec3d& point, const Vec3d& towardsLight);

/// How open the field is around `point`, 0 to 1, from phi at a few steps along the normal.
double openness(const DistanceField& field, const Vec3d& point, const Vec3d& normal, double reach);

} // namespace vdbounce
