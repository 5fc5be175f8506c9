// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/build/band_leaves.h"
#include "vdbounce/build/solid_groups.h"
#include "vdbounce/field/linear_transform.h"

#include <array>
#include <bitset>
#include <cstdint>
#include <memory>
#include <vector>

namespace vdbounce {

/// Leaves without any voxel of the band, one above the other, that are inside as a whole.
struct InsideRun {
    int leafX;
    int leafY;
    int zBegin;
    int zEnd;
};

/// A leaf without any voxel of the band that is inside in part: a hole opens there.
struct SplitLeaf {
    Vec3i leaf;
    std::bitset<BandLeaf::kVoxels> inside;
};

/// Voxels of the band that one way of telling the side calls inside and another outside.
struct Doubt {
    std::uint64_t voxels = 0;
    double confidence = 1.0;     ///< the least of any of them, 0 to 1
    Vec3d place = Vec3d::Zero(); ///< where that is, world

    Doubt& operator+=(const Doubt& other);
};

struct ColumnSigns {
    std::vector<InsideRun> inside;
    std::vector<SplitLeaf> split;
    Doubt holes;    ///< beside holes: the winding number is nearer to a half than to a whole, or caps say otherwise
    Doubt overlaps; ///< where bodies overlap: the parity of crossings says otherwise
};

/// Gives the distances of `leaves` their sign, negative inside, by following each column of voxels upwards through its
/// crossings; beside the holes of open groups blocks of voxels, down to single ones, ask for the winding number. Linear
/// in leaves and crossings.
ColumnSigns signByColumns(BandLeaves& leaves, const SolidGroups& solids, const std::vector<Crossing>& crossings,
                          const LinearTransform& transform, bool wantConfidence, const Progress& progress);

} // namespace vdbounce
