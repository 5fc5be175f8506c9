// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/io/height_map.h"

#include <string>

namespace vdbounce {

/// The greys of a PNG file as readHeightMap() describes them, of any size from 1 x 1.
/// Throws InputError for files that are damaged, cut short or no PNG.
HeightMap readPngHeights(const std::string& path);

} // namespace vdbounce
