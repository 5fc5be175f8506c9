// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "band_arguments.h"

#include <string>

namespace vdbounce::tool {

/// Where and how fine a level set is made: what all shapes of `make` take.
struct MakeArguments {
    std::string output;
    double voxel = 0.0; ///< world units
    BandArguments band;
    std::string name = "surface";
    bool half = false;
    std::uint64_t maxMemory = 0;

    double exteriorVx() const;
    double interiorVx() const;
};

void addMakeOptions(CLI::App& verb, MakeArguments& arguments);

/// Throws UsageError for what cannot be asked for together.
void requireSound(const MakeArguments& arguments);

} // namespace vdbounce::tool
