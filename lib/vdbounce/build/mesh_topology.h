// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/io/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vdbounce {

/// How a mesh's triangles hang together, and which way they face once that is made consistent.
///
/// Points at bitwise equal positions are one. Triangles that share an edge are of one component; where exactly two
/// share it they are made to face the same way, a patch of such triangles keeping the way of most of its area.
/// Triangles with a point twice are left out, and so are second copies of a triangle where they are not the walls of
/// two bodies.
struct MeshTopology {
    static constexpr std::uint32_t kNone = 0xffffffffu;

    struct Component {
        std::size_t triangles = 0;
        std::size_t openEdges = 0;        ///< with an odd number of triangles
        std::size_t nonManifoldEdges = 0; ///< with three or more
        std::size_t turned = 0;           ///< triangles that had to be turned
        bool orientable = true;           ///< false where turning them could not make all agree
        bool bounded = true;              ///< its triangles, as they face now, have no rim: no `rim` edge is its
        double area = 0.0;                ///< world
        double volume = 0.0;              ///< enclosed, world; negative where it faces inwards
    };

    /// An edge that the triangles of its component run along more often one way than the other: the rim of a hole, or a
    /// seam between triangles that cannot be made to agree.
    struct RimEdge {
        std::uint32_t from;
        std::uint32_t to;
        std::uint32_t component;
        std::uint32_t times; ///< how much more often they run from `from` to `to` than back
    };

    std::vector<TriangleMesh::Triangle> triangles; ///< by welded points, facing the way decided
    std::vector<std::uint32_t> component;          ///< of each triangle; kNone for those left out
    std::vector<Component> components;             ///< in the order of their first triangles
    std::vector<RimEdge> rim;
    std::size_t degenerate = 0; ///< triangles with a point twice
    std::size_t copies = 0;     ///< triangles left out as second copies of others
    std::size_t welded = 0;     ///< points at the position of another
    std::size_t unused = 0;     ///< points of no triangle
};

/// The numbers of the triangles of those components that have a flag in `wanted`, in order.
std::vector<std::uint32_t> trianglesOf(const MeshTopology& topology, const std::vector<char>& wanted);

/// A mesh of some of the triangles.
TriangleMesh partOf(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles);

/// Points on rims that are no farther apart than this, voxels, are torn apart rather than meant to be.
constexpr double kTornVx = 0.05;

/// Cost: linear in the mesh but for the sorting of each point's edges; some 0.2 microseconds a triangle.
MeshTopology findTopology(const TriangleMesh& mesh);

/// The same without any repair: all triangles but those with a point twice, as the file has them, as one component.
MeshTopology findTopologyAsIs(const TriangleMesh& mesh);

/// As findTopology(), where it is known which points are one: `pointOf` as weldEqual() returns it.
MeshTopology findTopology(const TriangleMesh& mesh, const std::vector<std::uint32_t>& pointOf);

/// Counts the triangles of each component and measures its area and volume anew, where `points` (of the mesh) have
/// moved.
void measureComponents(MeshTopology& topology, const std::vector<Vec3d>& points);

} // namespace vdbounce
