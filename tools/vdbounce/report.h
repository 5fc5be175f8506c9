// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verb.h"

#include "vdbounce/base/vector.h"

#include <nlohmann/json.hpp>

#include <string>

namespace vdbounce::tool {

using Json = nlohmann::ordered_json;

/// Prints what a verb did: the JSON object with --json, nothing with --quiet, else the text, a line or several.
void report(const CommonOptions& common, const Json& json, const std::string& text);

/// Prints a line on stderr for a reader who waits, not with --quiet nor --json.
void announce(const CommonOptions& common, const std::string& text);

/// Prints a warning on stderr, unless --quiet.
void warn(const CommonOptions& common, const std::string& text);

Json toJson(const Vec3d& v);

/// "12,345,678"
std::string grouped(std::uint64_t value);
/// A number with a few significant digits, for reading.
std::string rounded(double value);
/// Its three leading digits, grouped: "218,000".
std::string about(double value);
/// "12 MB", "1.5 GB"
std::string bytesText(double bytes);
/// "1 voxel", "1,234 voxels".
std::string counted(std::uint64_t count, const std::string& what);
std::string vectorText(const Vec3d& v);

} // namespace vdbounce::tool
