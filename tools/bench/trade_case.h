// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/step.h"
#include "vdbounce/field/field_options.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vdbounce::bench {

/// What was chosen. Steps have all of it, lookups alone no scheme, sweep and dt.
struct TradeSettings {
    double voxel = 0.0; ///< longest side, of scenes the finest level set's shortest, world units; 0: there is none
    FieldOptions field;
    std::optional<Scheme> scheme;
    std::optional<Sweep> sweep;
    std::optional<double> dt; ///< seconds
    bool precomputed = false; ///< gradients are stored beside phi, whatever `field.normal` is

    const char* normalName() const { return precomputed ? "precomputed" : nameOf(field.normal); }
};

/// Each of these of every repetition.
struct TradeCost {
    std::vector<double> nsPerParticleStep; ///< or per lookup, one thread
    std::vector<double> buildSeconds;      ///< the field from the grid in memory, all threads; of scenes all colliders
                                           ///< from their files
    std::size_t bytes = 0;                 ///< of the field, with gradients that are stored; of scenes all level sets
};

/// What one kind of error came to in each repetition, of which lookups and steps of known ways take other points and
/// particles.
struct TradeError {
    std::string name; ///< as the JSON has it
    std::vector<double> values;
};

/// One choice of settings, what it costs and how wrong it is.
struct TradeCase {
    std::string group; ///< what was measured on what: only cases of one group compare
    TradeSettings settings;
    TradeCost cost;
    std::vector<TradeError> errors; ///< the first is the one by which cases are called Pareto-optimal
    bool pareto = false;            ///< no other of the group is as cheap and as exact and better in one

    /// The settings in words.
    std::string name() const;

    /// The median, nanoseconds a particle and step, or a lookup.
    double ns() const;
    /// What comparing by cost goes by: ns(), and of steps the microseconds for a particle and second of the scene, or
    /// short steps would seem cheap.
    double price() const;
    /// The median of the first error.
    double error() const;

    /// Another repetition's errors, by name, in the same order as those before.
    void addErrors(const std::vector<std::pair<std::string, double>>& found);
};

/// Finds out which are.
void markPareto(std::vector<TradeCase>& cases);

} // namespace vdbounce::bench
