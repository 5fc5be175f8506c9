// SPDX-License-Identifier: Apache-2.0
#include "option_values.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/file_bytes.h"
#include "vdbounce/io/number_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

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

// The number of bytes that a suffix stands for; 0 where it is none.
double unitOf(char suffix)
{
    switch (std::toupper(static_cast<unsigned char>(suffix))) {
    case 'K': return 1e3;
    case 'M': return 1e6;
    case 'G': return 1e9;
    case 'T': return 1e12;
    default: return 0.0;
    }
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

CLI::Option* addSides(CLI::App& app, const std::string& name, std::optional<Vec3d>& target, const std::string& help)
{
    const auto parse = [&target, name](const std::string& text) {
        const auto side = parseDouble(text);
        const bool several = text.find(',') != std::string::npos;
        const Vec3d sides = several ? parseVector(name, text) : Vec3d(Vec3d::Constant(side.value_or(0.0)));
        if (!(sides.minCoeff() > 0.0) || !sides.allFinite()) {
            throw UsageError(name, "'" + text + "' is no size of a voxel",
                             "give a length above 0 in world units, or three with commas");
        }
        target = sides;
    };
    return app.add_option_function<std::string>(name, parse, help)->type_name("S|X,Y,Z");
}

CLI::Option* addBytes(CLI::App& app, const std::string& name, std::uint64_t& target, const std::string& help)
{
    constexpr double kMost = 1e18; // what still fits 64 bits
    const auto parse = [&target, name](const std::string& text) {
        const double unit = text.empty() ? 0.0 : unitOf(text.back());
        const auto value = parseDouble(std::string_view(text).substr(0, text.size() - (unit > 0.0 ? 1 : 0)));
        const double bytes = value.value_or(0.0) * (unit > 0.0 ? unit : 1.0);
        if (!(bytes >= 1.0) || bytes > kMost)
            throw UsageError(name, "'" + text + "' is no amount of memory", "write bytes, or for example 500M or 2G");
        target = static_cast<std::uint64_t>(bytes);
    };
    return app.add_option_function<std::string>(name, parse, help)->type_name("SIZE");
}

CLI::Option* addCount(CLI::App& app, const std::string& name, std::uint64_t& target, const std::string& help)
{
    constexpr double kMost = 1e11; // as many as fit the largest disks
    const auto parse = [&target, name](const std::string& text) {
        const auto value = parseDouble(text);
        if (!value || !(*value >= 0.0) || *value > kMost || *value != std::floor(*value)) {
            throw UsageError(name, "'" + text + "' is no number of particles", "give a whole number from 0 to 1e11");
        }
        target = static_cast<std::uint64_t>(*value);
    };
    return app.add_option_function<std::string>(name, parse, help)->type_name("N");
}

void requireOutput(const std::string& output, const std::vector<std::string>& endings,
                   const std::vector<std::string>& inputs)
{
    std::string known;
    for (const std::string& ending : endings) known += (known.empty() ? "." : ", .") + ending;
    if (std::find(endings.begin(), endings.end(), fileEnding(output)) == endings.end()) {
        throw UsageError(output, "'." + fileEnding(output) + "' is no format that this verb writes", "use " + known);
    }
    for (const std::string& input : inputs) {
        std::error_code missing;
        if (std::filesystem::equivalent(output, input, missing)) {
            throw UsageError(output, "is the input, which writing would destroy", "name another file");
        }
    }
}

} // namespace vdbounce::tool
