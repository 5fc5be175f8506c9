// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/io/height_map.h"

#include <string>

namespace vdbounce {

/// The numbers of a text file as readHeightMap() describes them, of any size from 1 x 1.
/// Throws InputError with the line and the column of what is no number or not finite, and for rows of unequal length.
HeightMap readTextHeights(const std::string& path);

} // namespace vdbounce
