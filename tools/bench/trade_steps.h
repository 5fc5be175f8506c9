// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/trade_lookups.h"

namespace vdbounce::bench {

/// Shots at a level set of a ball, whose ways are parabolas up to the first impact: every scheme, sweep and time step
/// with the usual lookup, and with the usual scheme and sweep every lookup, normal and storage. Nanoseconds a particle
/// and step, one thread. Errors, in voxels or relative: place (mean) and time (mean) of the first impact; the share of
/// shots that went through or never arrived; deepest penetration; and what the energy of particles that bounce without
/// loss drifts by in a second.
std::vector<TradeCase> tradeShots(const TradeOptions& options, Progress& progress);

/// Particles that slide down a slope with friction for a second, from rest: the error of the way, relative, mean.
std::vector<TradeCase> tradeSlides(const TradeOptions& options, Progress& progress);

} // namespace vdbounce::bench
