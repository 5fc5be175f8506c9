// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/field_options.h"
#include "vdbounce/field/left_out_voxels.h"

#include <cstdint>
#include <vector>

/// @file
/// What lookups near the surface of a level set are off by, told from its own voxels: while a scene runs, nothing knows
/// the surface any better.

namespace vdbounce {

/// One way to look the level set up, against the finest that there is: splines of float values with their slope.
struct ChoiceError {
    FieldOptions choice;
    double phi = 0.0;    ///< 99 of 100 lookups are off by no more; world units
    double normal = 0.0; ///< mean way, over a voxel, by which its unit normal leads off the spline's; world units
};

struct LookupErrors {
    double voxel = 0.0;               ///< the smallest side, world units
    std::uint64_t leaves = 0;         ///< of the level set, for the memory that a choice takes
    Resolution resolution;            ///< what nothing that looks the voxels up can tell
    std::vector<ChoiceError> choices; ///< those that the choices can be taken from, the fastest first

    /// What a choice is off by: its phi with what nothing can tell, or its normal, whichever is more; world units. Must
    /// be among `choices`.
    double of(const FieldOptions& choice) const;

    /// The least of all; infinite where the voxels do not tell.
    double reachable() const;

    /// The voxel's size with which a level set of the same surface would reach `error`, both world units.
    double voxelFor(double error) const;
};

/// Every choice that is the best in something, the fastest in collisions first, as bench trade finds them: Lookup::
/// Nearest is slower than Trilinear (its sweeps find no roots), and splines with central differences are slower and no
/// better than with their own slope. Half and Fixed8 are slower than Float and save memory.
const std::vector<FieldOptions>& choicesByCost();

/// Looks points up within a voxel of the surface, in a sample of the leaves. `seed` tells which and where. Zero errors
/// where the level set has no surface. Same result for any number of threads.
/// Cost: some tenths of a second, whatever the size.
LookupErrors measureLookupErrors(const LevelSetGrid& grid, std::uint64_t seed);

/// The same for one choice.
LookupErrors measureLookupErrors(const LevelSetGrid& grid, std::uint64_t seed, const FieldOptions& choice);

} // namespace vdbounce
