// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/particles/particles.h"

namespace vdbounce {

/// The voxel size, world units, for storing these particles in an OpenVDB points grid: a power of two at which about
/// eight of them share an occupied voxel, where most of them are.
///
/// A power of two, so that dividing by it is exact and a position that is a float relative to its voxel reads back
/// unchanged. Chosen by where the middle nine tenths lie, so that one stray particle far away does not coarsen the
/// rest. Large enough that every finite position has an index that fits OpenVDB's 32 bits.
double pointsVoxelSize(const Particles& particles);

} // namespace vdbounce
