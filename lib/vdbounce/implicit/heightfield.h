// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/height_surface.h"
#include "vdbounce/implicit/implicit_field.h"

namespace vdbounce {

/// A height map as a solid (lecture, slide 13): what lies between a flat bottom and the triangles of the map's cells,
/// each cut along the diagonal from its first to its last sample, with upright walls around. The solid that
/// heightfieldMesh() makes a mesh of.
///
/// phi is the exact signed distance to it everywhere, in double precision: beside, below and deep inside too. The
/// gradient is that of the nearest triangle, edge or corner; on the surface itself a triangle's normal.
///
/// Cost at a map of 1024 x 1024 with slopes around a half: 0.07 to 0.2 microseconds a point within a cell's side of the
/// surface, 0.8 at three sides, 2 to 3 at ten, 20 at the map's size; three times as much in steep hills. Memory: 14
/// bytes a sample.
class HeightfieldField final : public ImplicitField {
public:
    /// Throws what placeHeightMap() throws.
    HeightfieldField(const HeightMap& map, const HeightfieldOptions& options);

    double phi(const Vec3d& world, double time) const override;
    FieldSample sample(const Vec3d& world, double time) const override;

    /// The same bits as phi() at each point; faster, since each search begins at the last one's nearest cell.
    void phiInRow(const Vec3d& from, const Vec3d& step, int count, double time, double* out) const override;

    Box box() const override;

    /// The smallest of the lowest height above the bottom and the horizontal sides; and where any triangle is steeper
    /// than 45 degrees, of the sides of a cell, since ridges may then be as thin.
    double thinnestWall() const override { return thinnestWall_; }

private:
    enum class Where { Below, Beside, Above, Inside };
    struct Found {
        double phi;
        Where where;
        HeightSurface::Nearest nearest;
    };

    Found find(const Vec3d& p, HeightSurface::Cell start) const;
    Vec3d gradient(const Vec3d& p, const Found& found) const;
    Vec3d gradientOfSurface(const Vec3d& p, const Found& found) const;

    HeightSurface surface_;
    double thinnestWall_;
};

} // namespace vdbounce
