// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/length.h"
#include "vdbounce/base/vector.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

/// @file
/// Options whose values the contract spells in its own way: vectors "x,y,z", lengths "0.5" or "3vx", sizes "1280x960".

namespace vdbounce::tool {

CLI::Option* addVector(CLI::App& app, const std::string& name, Vec3d& target, const std::string& help);
CLI::Option* addVector(CLI::App& app, const std::string& name, std::optional<Vec3d>& target, const std::string& help);
CLI::Option* addLength(CLI::App& app, const std::string& name, std::optional<Length>& target, const std::string& help);
CLI::Option* addPixels(CLI::App& app, const std::string& name, int& width, int& height, const std::string& help);

} // namespace vdbounce::tool
