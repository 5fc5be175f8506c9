// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/length.h"
#include "vdbounce/base/progress.h"
#include "vdbounce/implicit/csg_operation.h"
#include "vdbounce/io/level_set_grid.h"

#include <string>
#include <vector>

namespace vdbounce {

/// On whose voxels the result of two grids with different ones lies.
enum class CsgVoxels {
    Finest, ///< on those of less volume, of equal ones on the first grid's: no detail of either is lost
    First,  ///< on the first grid's
};

struct GridCsgOptions {
    /// Rounds the edges where the two surfaces meet, and only there: within this distance of both. World units or
    /// longest sides of the result's voxels, >= 0.
    Length blend;
    CsgVoxels voxels = CsgVoxels::Finest;
    bool redistance = false; ///< make true distances of the result; see redistance()
    std::string name;        ///< of the result; empty: the first grid's
};

struct GridCsg {
    LevelSetGrid grid;
    std::vector<std::string> notes; ///< what was done besides, a sentence each: resampling, bands made narrower; and
                                    ///< when nothing is inside
};

/// A set operation on the solids of two level sets, grid point by grid point: min(a, b) for the union, max(a, b) for
/// the intersection, max(a, -b) for a without b (lecture, slides 17 and 27). The operands are not changed.
///
/// Exact: every voxel in the world, active or not, holds that of the two grids' values, to the bit; a voxel is active
/// where the operand is whose value it has. Where the grids' bands differ in width, values are cut to the narrower one.
///
/// The surface is right, phi next to an edge is not always the distance: outside of an edge that a subtraction or an
/// intersection makes (and inside of one that a union makes) it is the distance to the nearer of the two faces
/// prolonged. It is never more than the true distance there, so that no particle is missed; redistance makes it the
/// true one. Where the faces of a and b lie in each other, a subtraction leaves a sheet of zero distance and no
/// thickness, which only particles with a radius meet; redistance takes it away.
///
/// Blended values are no distances near the edge either.
///
/// Grids with different transforms: one is resampled onto the voxels of the other, with a note; see CsgVoxels. Two
/// transforms are the same where no voxel lies further apart than a ten-thousandth of a voxel.
///
/// Throws UsageError for CsgOperation::Complement, and for a blend that is negative or needs more of the bands than
/// there is; Interrupted. The same bits for any number of threads.
/// Cost: that of copying the leaves that stay; none for those that lie where the other grid decides.
GridCsg csg(CsgOperation operation, const LevelSetGrid& a, const LevelSetGrid& b, const GridCsgOptions& options = {},
            Progress& progress = Progress::none());

/// What is not in a: values are negated. Twice, it is the grid that it was.
///
/// The solid has no end, but a level set's background is positive: the grid is inside up to a box around all of a, with
/// a band's width and a leaf to spare, and outside beyond. DistanceField, whose box is that of the active voxels within
/// it, goes on inside beyond it (lecture, slide 29), and so does csg(), which finds the box in the grid's metadata.
/// Other programs see a solid that ends at the box. Throws InputError for a grid that holds nothing.
GridCsg complement(const LevelSetGrid& a, const GridCsgOptions& options = {}, Progress& progress = Progress::none());

} // namespace vdbounce
