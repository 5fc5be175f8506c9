// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"
#include "vdbounce/base/vector.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vdbounce {

/// Triangles that share points, world space. Seen from outside a triangle's corners run counter-clockwise.
struct TriangleMesh {
    using Triangle = std::array<std::uint32_t, 3>;

    std::vector<Vec3d> points;
    std::vector<Triangle> triangles;

    const Vec3d& corner(std::size_t triangle, int which) const
    {
        return points[triangles[triangle][static_cast<std::size_t>(which)]];
    }
};

/// The box around the points that triangles use; empty for a mesh without triangles.
Box boundingBox(const TriangleMesh& mesh);

/// For each point the first one at the same position, which may be itself. Positions are compared bit by bit, but for
/// the sign of zero. Linear in the number of points.
std::vector<std::uint32_t> weldEqual(const std::vector<Vec3d>& points);

/// Replaces points at bitwise equal positions by one, keeping the order of first appearance. Formats that store
/// each triangle's corners apart (stl) need it before edges can be told to be shared.
void weldEqualPoints(TriangleMesh& mesh);

/// How the triangles meet along their edges.
struct EdgeReport {
    std::size_t open = 0;         ///< edges with one triangle
    std::size_t nonManifold = 0;  ///< edges with three triangles or more
    std::size_t inconsistent = 0; ///< edges whose two triangles run along it in the same direction

    /// A surface without holes and with one orientation: inside and outside are well defined.
    bool closedAndOriented() const { return open == 0 && nonManifold == 0 && inconsistent == 0; }
};
EdgeReport inspectEdges(const TriangleMesh& mesh);

} // namespace vdbounce
