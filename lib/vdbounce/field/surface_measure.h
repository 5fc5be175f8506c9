// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"
#include "vdbounce/field/distance_field.h"

#include <vector>

namespace vdbounce {

/// A connected piece of the zero surface.
struct SurfacePiece {
    double area = 0.0;   ///< world units
    double volume = 0.0; ///< that it encloses: above 0 around a solid, below 0 around a cavity in one; 0 where open
    bool closed = true;  ///< false where the side of the grid's box cuts it off
    Vec3d place = Vec3d::Zero(); ///< a point on it, world
};

/// The zero surface of a level set: pieces, area and volume. See measureSurface().
struct SurfaceMeasure {
    std::vector<SurfacePiece> pieces; ///< in the order in which the field's blocks come upon them

    bool closed() const { return open == 0; }
    std::size_t solids = 0;   ///< closed pieces around a solid: its components, if all are closed
    std::size_t cavities = 0; ///< closed pieces around a cavity
    std::size_t open = 0;     ///< pieces that are cut off
    double area = 0.0;        ///< of all pieces within the box, world units
    double volume = 0.0;      ///< of the solids less the cavities; means nothing unless closed()
};

/// Follows the surface through the cells of the field's box. Each is cut into six tetrahedra, in which phi is linear,
/// and the volume within a piece is the sum of the cones over its triangles (the divergence theorem), whatever the
/// transform: rotated, sheared or mirrored. Pieces are apart where no triangles of theirs touch.
///
/// Error: against the surface that the voxels sample of second order in the voxel's size. A ball of r voxels comes out
/// 0.5 / r^2 too small in volume and 0.35 / r^2 in area (r = 10: half a percent). Sums are taken around
/// the piece itself, so that its distance from the origin costs no precision.
///
/// Throws UsageError for a field with another Storage than Float, whose blocks need not agree at their sides. Same bits
/// for any number of threads. Cost: some 110 nanoseconds a cell that the surface passes.
SurfaceMeasure measureSurface(const DistanceField& field);

} // namespace vdbounce
