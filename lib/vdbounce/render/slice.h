// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/distance_field.h"
#include "vdbounce/io/png_file.h"
#include "vdbounce/particles/particles.h"

#include <optional>

namespace vdbounce {

struct SliceOptions {
    int axis = 2;             ///< the world axis that the slice is perpendicular to: 0 x, 1 y, 2 z
    std::optional<double> at; ///< where it cuts that axis, world; else the middle of the field's box
    int size = 900;           ///< pixels of the longer side, 16 to 16384
    double margin = 0.15;     ///< shown around the field's box, as a share of its size, >= 0
    double slab = 0.0;        ///< particles within this distance of the slice are shown, world units; 0: two voxels
};

/// A cut through a field: blue outside and orange inside, paler away from the surface, a line at each voxel of distance
/// in the band, a black line at phi = 0, and particles near the cut as dots.
RgbImage renderSlice(const DistanceField& field, const Particles& particles, const SliceOptions& options);

} // namespace vdbounce
