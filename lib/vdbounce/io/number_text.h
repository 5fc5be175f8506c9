// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/length.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// @file
/// Numbers to and from text, independent of the locale. What is written reads back to the same bits.

namespace vdbounce {

/// The number that the whole of `text` spells, or nothing. Accepts a leading '+', "nan" and "inf".
std::optional<double> parseDouble(std::string_view text);
std::optional<std::int64_t> parseInteger(std::string_view text);

/// A length: "0.25" in world units, "3vx" in voxels.
std::optional<Length> parseLength(std::string_view text);

/// Appends the shortest text that reads back to `value`.
void appendNumber(std::string& out, double value);
void appendNumber(std::string& out, std::int64_t value);

/// The shortest text that reads back to `value`.
std::string numberText(double value);

/// An amount of memory, to two or three digits: "1.2 GB", "45 MB", "1 KB". Powers of 1000.
std::string sizeText(double bytes);

} // namespace vdbounce
