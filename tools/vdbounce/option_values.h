// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/error.h"
#include "vdbounce/base/length.h"
#include "vdbounce/base/vector.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// @file
/// Options whose values the contract spells in its own way: vectors "x,y,z", lengths "0.5" or "3vx", sizes
/// "1280x960", memory "2G".

namespace vdbounce::tool {

CLI::Option* addVector(CLI::App& app, const std::string& name, Vec3d& target, const std::string& help);
CLI::Option* addVector(CLI::App& app, const std::string& name, std::optional<Vec3d>& target, const std::string& help);
CLI::Option* addLength(CLI::App& app, const std::string& name, std::optional<Length>& target, const std::string& help);
CLI::Option* addPixels(CLI::App& app, const std::string& name, int& width, int& height, const std::string& help);

/// The sides of a voxel, world units: three above zero, "0.1,0.1,0.2", or one for all three.
CLI::Option* addSides(CLI::App& app, const std::string& name, std::optional<Vec3d>& target, const std::string& help);

/// An amount of memory, at least a byte: "500M", "2G"; K, M, G and T are powers of 1000, as in our messages.
CLI::Option* addBytes(CLI::App& app, const std::string& name, std::uint64_t& target, const std::string& help);

/// A number of particles; "1e6" is one too. At most a hundred thousand million.
CLI::Option* addCount(CLI::App& app, const std::string& name, std::uint64_t& target, const std::string& help);

/// One word of a list; `target`, a T or an optional one, becomes the value beside it.
template <class T, class Target>
CLI::Option* addChoice(CLI::App& app, const std::string& name, Target& target, const std::map<std::string, T>& choices,
                       const std::string& help)
{
    const auto parse = [&target, choices, name](const std::string& text) {
        const auto found = choices.find(text);
        if (found != choices.end()) {
            target = found->second;
            return;
        }
        std::string words;
        for (const auto& choice : choices) words += (words.empty() ? "" : ", ") + choice.first;
        throw UsageError(name, "'" + text + "' is not a choice", "use one of: " + words);
    };
    return app.add_option_function<std::string>(name, parse, help)->type_name("WORD");
}

/// The choices of an enumeration whose names stand in its order.
template <class Enum, std::size_t N> std::map<std::string, Enum> named(const char* const (&names)[N])
{
    std::map<std::string, Enum> choices;
    for (std::size_t i = 0; i < N; ++i) choices[names[i]] = Enum(i);
    return choices;
}

/// Refuses an output that has none of these endings or is one of the inputs, which it would destroy.
void requireOutput(const std::string& output, const std::vector<std::string>& endings,
                   const std::vector<std::string>& inputs);

} // namespace vdbounce::tool
