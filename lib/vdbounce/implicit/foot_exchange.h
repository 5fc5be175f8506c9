// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/foot_refinement.h"

namespace vdbounce {

/// Hands points from voxel to voxel within leaf `i`, starting from its own and from those of the leaves beside its
/// faces; where it is not `fresh` only the latter are new to its voxels. True when a voxel took one over; `changed`
/// becomes those that did.
bool exchangeFeet(FootLeaves& leaves, std::size_t i, const VoxelMetric& metric, Margin margin, bool fresh,
                  VoxelSet& changed);

} // namespace vdbounce
