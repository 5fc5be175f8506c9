// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vdbounce {

/// Rows from top to bottom, three bytes a pixel (red, green, blue), sRGB.
struct RgbImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> bytes;

    RgbImage(int w, int h) : width(w), height(h), bytes(std::size_t(w) * std::size_t(h) * 3) {}
};

/// Writes a PNG file, whole or not at all.
void writePng(const RgbImage& image, const std::string& path);

} // namespace vdbounce
