// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace vdbounce {

/// How the zero surface cuts a cell of 8 voxels: the cell is split into 6 tetrahedra around the diagonal from its low
/// to its high corner (Kuhn, Freudenthal), in each of which phi is linear and the surface flat. Neighbouring cells
/// split their common face alike, so that the surface is closed wherever phi is known around it.
///
/// Corner i of a cell lies at (i & 1, i >> 1 & 1, i >> 2 & 1). A tetrahedron's edges lead from a corner to one whose
/// bits contain its own: 12 edges of the cell, 6 diagonals of its faces and the one across.
struct TetrahedraCut {
    static constexpr int kEdges = 19;
    static constexpr int kFaceEdges = 5; ///< of a cell's edges, those in one of its faces
    static constexpr int kMostTriangles = 12;
    static constexpr std::uint8_t kNone = 255;

    struct Edge {
        std::uint8_t from;
        std::uint8_t to;
    };

    /// A cell whose corners inside (phi < 0) are the bits of a number.
    struct Case {
        std::uint8_t triangles = 0;
        std::uint8_t parts = 0;                                            ///< into which the surface in the cell falls
        std::array<std::array<std::uint8_t, 3>, kMostTriangles> corners{}; ///< of each triangle: the edge it lies on;
                                                                           ///< seen from outside counterclockwise
        std::array<std::uint8_t, kMostTriangles> partOfTriangle{};
        std::array<std::uint8_t, kEdges> partOfEdge{}; ///< kNone where the surface does not cross it
    };

    std::array<Edge, kEdges> edges{};
    std::array<Case, 256> cases{};
    /// For each axis the edges in the face at its low end, and in the same order those at its high end.
    std::array<std::array<std::uint8_t, kFaceEdges>, 3> lowFace{};
    std::array<std::array<std::uint8_t, kFaceEdges>, 3> highFace{};

    /// Made on the first call.
    static const TetrahedraCut& table();
};

} // namespace vdbounce
