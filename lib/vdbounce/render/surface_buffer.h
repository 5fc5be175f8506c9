// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"
#include "vdbounce/render/palette.h"

#include <limits>
#include <vector>

namespace vdbounce {

/// What each pixel of a picture shows before it is lit.
struct SurfaceBuffer {
    struct Pixel {
        float depth =
            std::numeric_limits<float>::infinity(); ///< along the camera's axis, world units; infinite for background
        Eigen::Vector3f normal = Eigen::Vector3f::Zero();
        Colour albedo = Colour::Zero(); ///< linear
        float gloss = 0.0f;
    };

    SurfaceBuffer(int w, int h) : width(w), height(h), pixels(std::size_t(w) * std::size_t(h)) {}
    Pixel& at(int x, int y) { return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
    const Pixel& at(int x, int y) const { return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }

    int width;
    int height;
    std::vector<Pixel> pixels;
};

} // namespace vdbounce
