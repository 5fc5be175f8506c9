// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

namespace vdbounce::tool {

void report(const CommonOptions& common, const Json& json, const std::string& text)
{
    if (common.json) {
        // What is not UTF-8, as a file name may be, is replaced rather than refused after the work is done.
        std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
    } else if (!common.quiet) {
        std::cout << text << '\n';
    }
    std::cout.flush();
}

void announce(const CommonOptions& common, const std::string& text)
{
    if (!common.quiet && !common.json) std::cerr << "vdbounce: " << text << std::endl;
}

void warn(const CommonOptions& common, const std::string& text)
{
    if (!common.quiet) std::cerr << "vdbounce: warning: " << text << '\n';
}

Json toJson(const Vec3d& v)
{
    // JSON has no infinity and no NaN.
    Json array = Json::array();
    for (double value : v) array.push_back(std::isfinite(value) ? Json(value) : Json(nullptr));
    return array;
}

std::string grouped(std::uint64_t value)
{
    std::string text = std::to_string(value);
    for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, ",");
    return text;
}

std::string rounded(double value)
{
    char text[32];
    std::snprintf(text, sizeof(text), "%.4g", value);
    return text;
}

std::string about(double value)
{
    const double unit = std::pow(10.0, std::max(0.0, std::floor(std::log10(std::max(value, 1.0))) - 2.0));
    return grouped(static_cast<std::uint64_t>(std::round(value / unit) * unit));
}

std::string bytesText(double bytes)
{
    const char* const units[] = {"kB", "MB", "GB", "TB"};
    double value = bytes / 1e3;
    std::size_t unit = 0;
    for (; value >= 999.5 && unit < 3; value /= 1e3) ++unit;
    char text[32];
    std::snprintf(text, sizeof(text), value < 9.95 ? "%.1f" : "%.0f", value);
    return std::string(text) + " " + units[unit];
}

std::string counted(std::uint64_t count, const std::string& what)
{
    return grouped(count) + " " + what + (count == 1 ? "" : "s");
}

std::string vectorText(const Vec3d& v)
{
    return "(" + rounded(v.x()) + ", " + rounded(v.y()) + ", " + rounded(v.z()) + ")";
}

} // namespace vdbounce::tool
