// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"
#include "vdbounce/base/vector.h"

#include <cstdint>
#include <memory>
#include <string>

namespace vdbounce {

/// An OpenVDB level set held in memory: a handle that keeps OpenVDB's headers, which cost ten seconds a file to
/// compile, out of code that only passes grids on. `vdbounce/io/openvdb_grid.h` converts from and to
/// openvdb::FloatGrid.
///
/// Values are signed distances in world units, negative inside, float; grids stored as half or double are
/// converted when read.
class LevelSetGrid {
public:
    struct Holder; ///< defined in openvdb_grid.h

    LevelSetGrid() = default;
    explicit LevelSetGrid(std::shared_ptr<const Holder> holder) : holder_(std::move(holder)) {}

    const Holder& holder() const { return *holder_; }

private:
    std::shared_ptr<const Holder> holder_;
};

/// What the header and the tree's shape tell of a level set, without looking at its values.
struct LevelSetSummary {
    std::string name;
    std::string valueType;    ///< as stored: "float", "half", "double"
    Vec3d voxelSize;          ///< world units along the index axes
    double background = 0.0;  ///< world units
    double halfWidthVx = 0.0; ///< background over the smallest voxel side
    std::uint64_t activeVoxels = 0;
    std::uint64_t leaves = 0;
    std::uint64_t memoryBytes = 0;
    Vec3i indexMin = Vec3i::Zero(); ///< the box of the active voxels, inclusive; min > max when there are none
    Vec3i indexMax = Vec3i::Zero();
    Box worldBox; ///< around the centres of the active voxels
};
LevelSetSummary summarize(const LevelSetGrid& grid);

} // namespace vdbounce
