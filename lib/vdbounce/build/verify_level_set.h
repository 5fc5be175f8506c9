// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/build/sign_method.h"
#include "vdbounce/io/level_set_grid.h"
#include "vdbounce/io/triangle_mesh.h"

#include <cstdint>

namespace vdbounce {

struct VerifyOptions {
    std::uint64_t samples = 10000; ///< active voxels to check, evenly spread over the grid; all when there are fewer
    SignMethod sign = SignMethod::Auto; ///< as the conversion was asked for; flood may fill cavities
    double thickness = 0.0;             ///< of sheets, world units
    bool half = false;                  ///< compare the values as 16-bit floats hold them
};

/// How far a level set is from the mesh it was made of.
struct VerifyReport {
    std::uint64_t samples = 0;
    double maxErrorVx = 0.0;      ///< largest | |phi| - distance |, voxels of the longest side
    double rmsErrorVx = 0.0;      ///< root mean square of it, voxels
    std::uint64_t signErrors = 0; ///< voxels on the wrong side
};

/// Compares active voxels with the distance and side that a search of the mesh in double precision finds, voxel by
/// voxel (see MeshOracle). Cost: some 10 microseconds a sample, and a tree over the mesh.
VerifyReport verifyLevelSet(const LevelSetGrid& grid, const TriangleMesh& mesh, const VerifyOptions& options = {});

} // namespace vdbounce
