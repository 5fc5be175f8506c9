// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/io/level_set_grid.h"
#include "vdbounce/io/triangle_mesh.h"

#include <cstdint>

namespace vdbounce {

struct VerifyOptions {
    std::uint64_t samples = 10000; ///< active voxels to check, evenly spread over the grid; all when there are fewer
    SignMethod sign =
        SignMethod::Winding; ///< how the grid was signed: a sheet's has no sides, and flood may fill cavities
    bool half = false;       ///< compare the values as 16-bit floats hold them
};

/// How far a level set is from the mesh it was made of.
struct VerifyReport {
    std::uint64_t samples = 0;
    double maxErrorVx = 0.0;      ///< largest | |phi| - distance |, voxels
    double rmsErrorVx = 0.0;      ///< root mean square of it, voxels
    std::uint64_t signErrors = 0; ///< voxels on the wrong side by the grid's own sign method, asked anew for each
};

/// Compares active voxels with the exact distance to the mesh (a search tree in double precision, independent of how
/// the grid was made). `offset` is what was subtracted from the distance: half the thickness of a sheet, else 0.
VerifyReport verifyLevelSet(const LevelSetGrid& grid, const TriangleMesh& mesh, double offset,
                            const VerifyOptions& options = {});

} // namespace vdbounce
