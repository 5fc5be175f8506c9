// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"
#include "vdbounce/field/distance_field.h"
#include "vdbounce/particles/particles.h"

#include <cstdint>
#include <optional>

namespace vdbounce {

/// What every emitted particle carries besides its position. Ids are 0, 1, 2, ...
struct EmitOptions {
    std::uint64_t count = 0;
    std::uint64_t seed = 1; ///< equal seeds give equal particles, for any number of threads
    std::optional<Vec3d> velocity;
    std::optional<double> radius; ///< world units, >= 0
    std::optional<double> mass;   ///< > 0
};

/// Uniformly distributed in the box. Throws UsageError for a box whose min exceeds its max, and options out of range.
Particles emitInBox(const Box& box, const EmitOptions& options);

/// Uniformly distributed in the ball.
Particles emitInSphere(const Vec3d& centre, double radius, const EmitOptions& options);

/// On the level set phi = `offset` (world units), uniformly by area to first order: points scattered in the cells that
/// the level set crosses are moved onto it along the gradient. Throws InputError where the field has no such cells,
/// that is for an empty grid or an offset beyond its band.
Particles emitOnSurface(const DistanceField& field, double offset, const EmitOptions& options);

} // namespace vdbounce
