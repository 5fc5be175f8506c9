// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/trade_lookups.h"

namespace vdbounce::bench {

/// A scene of the user's own, with every lookup, normal and storage at the scene's own way to step, and every scheme,
/// sweep and time step (the scene's, twice, half and a quarter of it, as the steps of a frame allow) at its own
/// accuracy. Errors are against a run of the finest settings: cubic splines with their slope, floats, collide-contact,
/// always swept, an eighth of the time step. Place of the first impact, mean and largest, and final position, mean, in
/// voxels of the finest level set, or world units where there is none; time of the first impact, mean and largest; the
/// share of particles of which one run hit something and the other did not; deepest penetration; and the difference of
/// all energy at the end, relative to the most kinetic energy of the finest run. Nanoseconds a particle and step, one
/// thread; the time to build is that to read all colliders from their files.
///
/// Of particles `options.shots` at most, evenly picked; of frames `options.frames`. Where colliders delete, particles
/// stay where they hit, so that runs can be compared particle by particle. Nothing is written.
///
/// Throws what reading and running the scene throws; UsageError for scenes in which none of these particles hits
/// anything and for those with a collider that deletes and has a mass.
std::vector<TradeCase> tradeScene(const std::string& file, const TradeOptions& options, Progress& progress);

} // namespace vdbounce::bench
