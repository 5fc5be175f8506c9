// SPDX-License-Identifier: Apache-2.0
#include "report.h"

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

std::string vectorText(const Vec3d& v)
{
    return "(" + rounded(v.x()) + ", " + rounded(v.y()) + ", " + rounded(v.z()) + ")";
}

} // namespace vdbounce::tool
