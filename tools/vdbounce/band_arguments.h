// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "option_values.h"

#include <optional>
#include <string>

namespace vdbounce::tool {

/// How wide a level set's band is to be: --band for both sides, or --exterior and --interior.
struct BandArguments {
    std::optional<Length> band;
    std::optional<Length> exterior;
    std::optional<Length> interior;

    /// The half width outside, if any was given, and that inside.
    std::optional<Length> outside() const { return exterior ? exterior : band; }
    std::optional<Length> inside() const { return interior ? interior : band; }

    /// True where a side was given twice.
    bool clash() const { return band && (exterior || interior); }
};

/// `standard` tells what the width is where none is given: "default 3vx".
void addBandOptions(CLI::App& verb, BandArguments& arguments, const std::string& standard);

/// Throws UsageError of `verb`, "vdbounce mesh2ls", where a side was given twice.
void requireNoClash(const BandArguments& arguments, const std::string& verb);

} // namespace vdbounce::tool
