// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report.h"

#include "vdbounce/io/grid_file.h"

#include <string>

/// @file
/// What `info` tells of each thing that a file holds.

namespace vdbounce::tool {

struct Description {
    Json json;
    std::string text; ///< a headline, and under it indented lines
};

Description describeMesh(const std::string& path);
Description describeParticles(const std::string& path);

/// Of one grid of a .vdb file, particles included.
Description describeGrid(const std::string& path, const GridEntry& entry);

/// An indented line with a label in front, for under a headline.
std::string labelled(const std::string& label, const std::string& text);

} // namespace vdbounce::tool
