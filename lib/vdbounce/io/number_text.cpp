// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/number_text.h"

#include <charconv>
#include <cmath>

namespace vdbounce {
namespace {

// Longest shortest-form double is 24 characters ("-2.2250738585072014e-308"); an int64 has 20.
constexpr std::size_t kNumberBuffer = 32;

template <class T> std::optional<T> parseWhole(std::string_view text)
{
    if (!text.empty() && text.front() == '+') {
        text.remove_prefix(1);
        if (!text.empty() && text.front() == '-') return std::nullopt;
    }
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

template <class T> void append(std::string& out, T value)
{
    char buffer[kNumberBuffer];
    const auto result = std::to_chars(buffer, buffer + kNumberBuffer, value);
    out.append(buffer, result.ptr);
}

} // namespace

std::optional<double> parseDouble(std::string_view text) { return parseWhole<double>(text); }

std::optional<std::int64_t> parseInteger(std::string_view text) { return parseWhole<std::int64_t>(text); }

std::optional<Length> parseLength(std::string_view text)
{
    constexpr std::string_view kVoxels = "vx";
    const bool inVoxels = text.size() > kVoxels.size() && text.substr(text.size() - kVoxels.size()) == kVoxels;
    if (inVoxels) text.remove_suffix(kVoxels.size());
    const auto value = parseDouble(text);
    if (!value) return std::nullopt;
    return Length{*value, inVoxels};
}

void appendNumber(std::string& out, double value) { append(out, value); }

void appendNumber(std::string& out, std::int64_t value) { append(out, value); }

std::string numberText(double value)
{
    std::string text;
    appendNumber(text, value);
    return text;
}

std::string sizeText(double bytes)
{
    const char* units[] = {"KB", "MB", "GB", "TB"};
    std::size_t unit = 0;
    for (bytes /= 1e3; bytes >= 1e3 && unit < 3; bytes /= 1e3) ++unit;
    return numberText(bytes < 10.0 ? std::round(bytes * 10.0) / 10.0 : std::round(bytes)) + " " + units[unit];
}

} // namespace vdbounce
