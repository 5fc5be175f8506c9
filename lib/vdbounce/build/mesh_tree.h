// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"
#include "vdbounce/io/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace vdbounce {

/// A bounding volume hierarchy over a mesh's triangles that answers what is exact to ask of a mesh, in double
/// precision: distance, winding number, crossings. Read-only after construction, safe to use from any number of
/// threads. The mesh must outlive it. Cost: O(n log n) to build, 112 bytes a node and half a node a triangle.
class MeshTree {
public:
    explicit MeshTree(const TriangleMesh& mesh);

    struct Closest {
        double distance = 0.0; ///< world units, >= 0
        Vec3d point;
        std::uint32_t triangle = 0;
    };
    /// The closest point of the mesh, exact.
    Closest closest(const Vec3d& p) const;

    /// How often the mesh winds around p: 1 inside, 0 outside of a closed outward-facing mesh, and in between near
    /// holes. Far groups of triangles count as a dipole, the first order of Barill et al. 2018: within 0.05 of the
    /// exact sum.
    double windingNumber(const Vec3d& p) const;

    static constexpr int kRays = 5;

    /// How many of several rays from p in fixed oblique directions cross the mesh an odd number of times, 0 to kRays.
    int raysInside(const Vec3d& p) const;

    /// True when p is inside by the parity of crossings, the majority of those rays.
    bool insideByParity(const Vec3d& p) const { return 2 * raysInside(p) > kRays; }

private:
    struct Node {
        Box box;
        Vec3d centroid = Vec3d::Zero(); // weighted by area
        Vec3d areaNormal = Vec3d::Zero();
        double radius = 0.0; // of a ball around the centroid that holds the node's triangles
        std::uint32_t first =
            0; // a leaf's first triangle in order_, or the inner node's second child; the first follows it
        std::uint32_t count = 0; // triangles of a leaf; 0 for an inner node
    };

    std::uint32_t build(std::uint32_t begin, std::uint32_t end, const std::vector<Vec3d>& centroids);
    void summarize(Node& node, std::uint32_t begin, std::uint32_t end) const;
    bool crossingsOdd(const Vec3d& origin, const Vec3d& direction) const;

    const TriangleMesh& mesh_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

} // namespace vdbounce
