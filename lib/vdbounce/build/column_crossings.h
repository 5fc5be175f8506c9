// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/field/linear_transform.h"
#include "vdbounce/io/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace vdbounce {

/// Triangles that bound bodies: each belongs to a group, and every edge is run along as often one way as the other by
/// the triangles of a group.
struct ClosedMesh {
    static constexpr std::uint32_t kNone = 0xffffffffu;

    const std::vector<Vec3d>* points = nullptr; ///< of the mesh it was made of, world
    std::vector<Vec3d> tips;                    ///< further points, numbered on from those
    std::vector<TriangleMesh::Triangle> triangles;
    std::vector<std::uint32_t> group; ///< of each triangle; kNone for those that are no part of it

    std::size_t pointCount() const { return points->size() + tips.size(); }
    const Vec3d& point(std::size_t p) const { return p < points->size() ? (*points)[p] : tips[p - points->size()]; }
};

/// Where the line through the voxel centres of one column, along the index z axis, crosses a triangle.
struct Crossing {
    std::int32_t leafX; ///< leaf coordinates of the column
    std::int32_t leafY;
    double z;            ///< index space
    std::uint32_t group; ///< of the triangle
    std::int16_t column; ///< 8 x + y within the leaf
    std::int16_t change; ///< of the group's winding number on the way up: 1 where the line enters, -1 where it leaves

    bool sameLeafColumn(const Crossing& o) const { return leafX == o.leafX && leafY == o.leafY; }
};

/// All crossings of all columns of voxel centres, in the order of leaf columns, then upwards.
///
/// Guarantee: a group's changes along a column add up to zero, and what is between is its winding number, whatever the
/// shape of its triangles: corners are rounded to 2^-24 of a voxel (coarser only for boxes beyond 2^26 voxels), sides
/// of edges are told in whole numbers, and columns that run exactly through an edge or a corner are taken to pass
/// beside it, by the same tiny shift for all triangles (simulation of simplicity, Edelsbrunner and Muecke 1990).
std::vector<Crossing> findCrossings(const ClosedMesh& mesh, const LinearTransform& transform, const Progress& progress);

} // namespace vdbounce
