// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/length.h"
#include "vdbounce/base/progress.h"
#include "vdbounce/io/level_set_grid.h"
#include "vdbounce/io/scalar_grid.h"

#include <cstdint>
#include <optional>
#include <string>

namespace vdbounce {

/// On which side of the surface a function's values are inside.
enum class Inside {
    Below, ///< where they are smaller than at the surface: signed distance, implicit functions as the lecture has them
    Above, ///< where they are larger: density, fog volumes
};

struct RedistanceOptions {
    double iso = 0.0; ///< the value at the surface, in units of the grid's values
    Inside inside = Inside::Below;
    /// The band outside and inside, at least one voxel. Left out: that of the grid where it is a level set, else 3
    /// voxels. In voxels: of the longest side. Time and memory grow with the voxels that the wider of both holds.
    std::optional<Length> exterior;
    std::optional<Length> interior;
    std::string name;            ///< of the result; empty: the grid's own
    std::uint64_t maxMemory = 0; ///< bytes; what needs more is refused; 0: three quarters of the machine's
};

/// Signed distance to the surface on which `implicit` takes the value `iso`: of a level set that lost its unit
/// gradient, of a function that never had it, of a fog volume. The surface stays where it is; the band becomes as wide
/// or narrow as asked, on each side by itself. Any linear transform: distances are world units.
///
/// The result is a level set on the same voxels: active where -interior < phi < exterior, `exterior` (the background)
/// beyond, -interior inside, in tiles where nothing is active. OpenVDB's checkLevelSet accepts it. The sign of a voxel
/// is that of its value less `iso`; a value equal to `iso` is outside.
///
/// What is known: with Inside::Above all of space, the background being what there is outside the active voxels (no
/// density). With Inside::Below only active voxels have values; level sets also tell the side beyond by their tiles and
/// background, other grids need not. A grid must be active where the surface is, one voxel to each side; with three
/// or more to each side the error is as stated.
///
/// Where the active voxels end and a surface does too, it was cut off ("clipped"): none is made up there. Voxels whose
/// closest point would be on the missing part stay inactive, so the band ends about where the surface does.
///
/// Error: where the function is smooth and the surface's radii of curvature are R voxels, at most some 0.8/R^3 voxels
/// (a sphere of 50 voxels, band 3: 5e-6). Edges and corners are known no better than their cell: of right angles some
/// half a voxel at an edge, 0.8 at a corner of three, little two voxels beside it; outside, nothing where they pass
/// through voxel centres and values are zero there; at sharper edges more. Features that no sign change between
/// neighbouring voxels shows do not exist.
///
/// Method: each cell with a sign change gets a cubic polynomial fitted to the 32 voxels in it and beside its faces, or,
/// where that is not smooth, the triangles of marching tetrahedra and the crossings of the cell's diagonals. Points of
/// these patches are handed from voxel to voxel (vector distance transform, Danielsson 1980); each voxel then finds the
/// closest point of its patch by Newton's method, which improves on the alternation of Chopp (2001). So the error does
/// not grow with the distance, as it does when phi itself is swept outwards.
///
/// The same bits for any number of threads and any processor. Memory besides the result: 10 KB for each 8^3 leaf within
/// the band, and 120 bytes for each cell on the surface.
///
/// Throws InputError for a grid without active voxels, whose values are all on one side of `iso` (naming their range),
/// with an active value that is not a finite number (naming the voxel), or whose transform is not linear; UsageError
/// for a band below one voxel and for what needs more than maxMemory; Interrupted.
LevelSetGrid redistance(const ScalarGrid& implicit, const RedistanceOptions& options = {},
                        Progress& progress = Progress::none());

} // namespace vdbounce
