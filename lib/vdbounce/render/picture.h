// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/field/distance_field.h"
#include "vdbounce/io/png_file.h"
#include "vdbounce/particles/particles.h"

#include <memory>
#include <optional>
#include <vector>

namespace vdbounce {

struct PictureOptions {
    int width = 1280; ///< pixels, 16 to 16384
    int height = 960;
    Vec3d view = Vec3d(0.5, 0.4, 1.0); ///< from the scene towards the eye
    Vec3d up = Vec3d(0.0, 1.0, 0.0);
    std::optional<double> ground; ///< height along `up` of a floor that receives shadows, world units
    double particleRadius =
        0.0; ///< how large to draw particles, world units; 0: their own radius, or one that suits their number
    std::optional<Box> frame; ///< what to show, world; else everything
};

/// A shaded picture of level sets with particles over them, coloured by speed, with shadows. Needs no display. The same
/// picture for any number of threads. Throws UsageError for options out of range, InputError when there is nothing to
/// show.
RgbImage renderPicture(const std::vector<std::shared_ptr<const DistanceField>>& fields, const Particles& particles,
                       const PictureOptions& options, Progress& progress = Progress::none());

} // namespace vdbounce
