// SPDX-License-Identifier: Apache-2.0
#include "band_arguments.h"

namespace vdbounce::tool {

void addBandOptions(CLI::App& verb, BandArguments& arguments, const std::string& standard)
{
    addLength(verb, "--band", arguments.band, "Half width of the narrow band on both sides (" + standard + ")");
    addLength(verb, "--exterior", arguments.exterior, "Half width outside");
    addLength(verb, "--interior", arguments.interior, "Half width inside");
}

void requireNoClash(const BandArguments& arguments, const std::string& verb)
{
    if (arguments.clash()) throw UsageError(verb, "--band excludes --exterior and --interior", "give one or the other");
}

} // namespace vdbounce::tool
