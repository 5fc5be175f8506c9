// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "make_arguments.h"
#include "verb.h"

#include "vdbounce/io/level_set_grid.h"

#include <string>

namespace vdbounce::tool {

/// Writes what `make` made of `shape` in `buildSeconds`, and reports it.
void writeMade(const LevelSetGrid& grid, const std::string& shape, const MakeArguments& arguments, double buildSeconds,
               const CommonOptions& common);

} // namespace vdbounce::tool
