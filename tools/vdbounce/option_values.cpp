// SPDX-License-Identifier: Apache-2.0
#include "option_values.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/number_text.h"

#include <cmath>

namespace vdbounce::tool {
namespace {

Vec3d parseVector(const std::string& name, const std::string& text)
{
    Vec3d vector;
    std::size_t begin = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const std::size_t comma = text.find(',', begin);
        const bool last = axis == 2;
        const auto value = parseDouble(std::string_view(text).substr(begin, comma - begin));
        if (!value || !std::isfinite(*value) || (comma == std::string::npos) != last) {
            throw UsageError(name, "'" + text + "' is no vector", "write three numbers with commas, 0,-9.81,0");
        }
        vector[axis] = *value;
        begin = comma + 1;
    }
    return vector;
}

template <class Target>
CLI::Option* addVectorTo(CLI::App& app, const std::string& name, Target& target, const std::string& help)
{
    return app
        .add_option_function<std::string>(
            name, [&target, name](const std::string& text) { target = parseVector(name, text); }, help)
        ->type_name("X,Y,Z");
}

} // namespace

CLI::Option* addVector(CLI::App& app, const std::string& name, Vec3d& target, const std::string& help)
{
    return addVectorTo(app, name, target, help);
}

CLI::Option* addVector(CLI::App& app, const std::string& name, std::optional<Vec3d>& target, const std::string& help)
{
    return addVectorTo(app, name, target, help);
}

CLI::Option* addLength(CLI::App& app, const std::string& name, std::optional<Length>& target, const std::string& help)
{
    const auto parse = [&target, name](const std::string& text) {
        const auto length = parseLength(text);
        if (!length || !std::isfinite(length->value)) {
            throw UsageError(name, "'" + text + "' is no length", "write a number in world units, or in voxels as 3vx");
        }
        target = *length;
    };
    return app.add_option_function<std::string>(name, parse, help)->type_name("LENGTH");
}

CLI::Option* addPixels(CLI::App& app, const std::string& name, int& width, int& height, const std::string& help)
{
    const auto parse = [&width, &height, name](const std::string& text) {
        const std::size_t cross = text.find('x');
        const auto w = parseInteger(std::string_view(text).substr(0, cross));
        const auto h =
            cross == std::string::npos ? std::nullopt : parseInteger(std::string_view(text).substr(cross + 1));
        if (!w || !h || *w < 1 || *h < 1 || *w > 1000000 || *h > 1000000) {
            throw UsageError(name, "'" + text + "' is no size", "write WIDTHxHEIGHT, 1280x960");
        }
        width = int(*w);
        height = int(*h);
    };
    return app.add_option_function<std::string>(name, parse, help)->type_name("WxH");
}

} // namespace vdbounce::tool
