// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

/// @file
/// The command line that repeats a run, as a shell takes it.

namespace vdbounce::tool {

class CommandText {
public:
    /// @param verb  what stands after "vdbounce", "bench mesh"
    explicit CommandText(const std::string& verb) : text_("vdbounce " + verb) {}

    /// Files: quoted where a shell would read something else.
    void add(const std::vector<std::string>& words);

    template <class Number> void option(const std::string& name, const Number& value)
    {
        // All the digits that tell the value, and no more.
        text_ += " " + name + " " + nlohmann::json(value).dump();
    }

    /// Nothing where there are no values.
    template <class Number> void option(const std::string& name, const std::vector<Number>& values)
    {
        if (!values.empty()) text_ += " " + name;
        for (const Number& value : values) text_ += " " + nlohmann::json(value).dump();
    }

    const std::string& text() const { return text_; }

private:
    std::string text_;
};

} // namespace vdbounce::tool
