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

struct TradeCost {
    std::vector<double> nsPerParticleStep; ///< or per lookup, one thread; of each repetition
    double buildSeconds = 0.0; ///< the field from the grid in memory, all threads, the fastest repetition; of scenes
                               ///< all colliders from their files, once
    std::size_t bytes = 0;     ///< of the field, with gradients that are stored; of scenes all level sets

    double ns() const; ///< the median
};

/// One choice of settings, what it costs and how wrong it is.
struct TradeCase {
    std::string group; ///< what was measured on what: only cases of one group compare
    TradeSettings settings;
    TradeCost cost;
    /// By the names that the JSON has; the first is the one by which cases are called Pareto-optimal.
    std::vector<std::pair<std::string, double>> errors;
    bool pareto = false; ///< no other of the group is as cheap and as exact and better in one

    /// The settings in words.
    std::string name() const;
};

/// Finds out which are.
void markPareto(std::vector<TradeCase>& cases);

} // namespace vdbounce::bench
