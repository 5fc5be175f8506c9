// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/height_map.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/file_bytes.h"
#include "vdbounce/io/png_heights.h"
#include "vdbounce/io/text_heights.h"

namespace vdbounce {
namespace {

HeightMap readByEnding(const std::string& path)
{
    const std::string ending = fileEnding(path);
    if (ending == "png") return readPngHeights(path);
    if (ending == "csv" || ending == "txt") return readTextHeights(path);
    throw InputError(path, "'" + ending + "' is no height map format", "name a .png, .csv or .txt file");
}

} // namespace

HeightMap readHeightMap(const std::string& path)
{
    HeightMap map = readByEnding(path);
    if (map.columns < 2 || map.rows < 2) {
        throw InputError(path,
                         "has " + std::to_string(map.columns) + " x " + std::to_string(map.rows) +
                             " heights (columns x rows), which span no surface",
                         "give two columns and two rows at least");
    }
    return map;
}

} // namespace vdbounce
