// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/height_cell.h"
#include "vdbounce/implicit/height_grid.h"
#include "vdbounce/implicit/height_pyramid.h"

namespace vdbounce {

/// The triangles of a height map, and which of them is nearest to a point: branch and bound in a pyramid of the lowest
/// and highest heights (as Tevs, Ihrke and Seidel 2008 use for rays), entered at the level whose nodes are as large as
/// the distance to the cell below the point, so that points near the surface look at a few cells only.
///
/// Lengths are world units from the grid's origin. Read-only and safe to use from any number of threads.
class HeightSurface {
public:
    struct Cell {
        int column = -1;
        int row = -1;
    };

    /// The nearest that is known so far.
    struct Nearest {
        double distance2;
        Cell cell; ///< no cell, column -1, where what is nearest is none of the triangles
        HeightCellPart part = HeightCellPart::FaceRight;
    };

    explicit HeightSurface(HeightGrid grid) : grid_(std::move(grid)), pyramid_(grid_) {}

    const HeightGrid& grid() const { return grid_; }

    /// Sets `best` to the nearest triangle if that is nearer. The distance's bits do not depend on the cell to `start`
    /// with, nor on how large the distance in `best` is while it is larger; the closer, the faster. Of equally near
    /// cells any one.
    void improve(Nearest& best, const Vec3d& p, Cell start) const;

    /// The cell over or below a point, or the nearest to that.
    Cell cellAt(const Vec3d& p) const { return {grid_.cellX(p.x()), grid_.cellZ(p.z())}; }

    /// A cell, and the place of its first sample.
    HeightCell cell(Cell at) const;
    Vec3d corner(Cell at) const;

private:
    class Search;

    HeightGrid grid_;
    HeightPyramid pyramid_;
};

} // namespace vdbounce
