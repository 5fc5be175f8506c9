// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/field/linear_transform.h"
#include "vdbounce/implicit/grid_csg_rule.h"
#include "vdbounce/io/openvdb_grid.h"

namespace vdbounce {

/// The level set on other voxels, those of `onto`: rotated, sheared, finer, coarser.
///
/// Values are trilinear in `band`, which is to be a voxel's diagonal narrower than the source's, so that no value
/// beyond its own is mixed in; beyond they are the band's widths with the sign of the source's nearest voxel, so that
/// what is inside stays so however large it is. Where the source's surface is cut off by the box of its active voxels,
/// it ends at the same place. Only leaves near the band are looked at. Throws Interrupted. In parallel, the same for
/// any number of threads. Cost: some 10 microseconds for each leaf near the band, and the source's memory 2.6 times
/// while it is looked up.
openvdb::FloatGrid::Ptr resampled(const LevelSetGrid& source, const LinearTransform& onto, const CsgBand& band,
                                  Progress& progress);

} // namespace vdbounce
