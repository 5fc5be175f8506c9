// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/png_file.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/safe_file.h"

#include <png.h>

namespace vdbounce {

void writePng(const RgbImage& image, const std::string& path)
{
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    header.width = static_cast<png_uint_32>(image.width);
    header.height = static_cast<png_uint_32>(image.height);
    header.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = 0;
    std::string encoded;
    bool good = png_image_write_to_memory(&header, nullptr, &size, 0, image.bytes.data(), 0, nullptr) != 0;
    if (good) {
        encoded.resize(size);
        good = png_image_write_to_memory(&header, encoded.data(), &size, 0, image.bytes.data(), 0, nullptr) != 0;
    }
    if (!good) throw RunError(path, std::string("cannot be encoded (") + header.message + ")", "give a smaller --size");
    encoded.resize(size);
    writeTextFile(path, encoded);
}

} // namespace vdbounce
