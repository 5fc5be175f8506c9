// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/build/mesh_tree.h"
#include "vdbounce/io/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace vdbounce {

/// Cones over the rims of holes, and how much they wind around points and balls. Read-only after construction, safe to
/// use from any number of threads.
class HoleCaps {
public:
    /// Of each triangle the first corner is the cone's tip; the others are on the rim.
    explicit HoleCaps(TriangleMesh cones);

    HoleCaps(const HoleCaps&) = delete;
    HoleCaps& operator=(const HoleCaps&) = delete;

    struct Range {
        double middle;      ///< the cones' winding number at the ball's centre
        double uncertainty; ///< how far from it that at any other point of the ball may be; 1 and more where a cone is
                            ///< in the way
    };
    /// Method: a winding number changes along a way as the magnetic field of a current in the rim (Biot and Savart), so
    /// by no more than length / (4 pi distance^2) of each piece of rim; across a cone it jumps by one.
    Range around(const Vec3d& centre, double radius) const;

    /// True when the cones lie about where the winding number of the open mesh is a half, so that they can stand for
    /// walls: so they do over holes that are flat or nearly so, but not over rims that run far through space.
    bool fitAsWalls() const;

private:
    struct Piece {
        Vec3d from;
        Vec3d to;
    };
    // A node's rim is pieces_[begin .. end); its children follow each other at `child`.
    struct Node {
        Box box;
        double length = 0.0;
        std::uint32_t begin = 0;
        std::uint32_t end = 0;
        std::uint32_t child = 0; // 0 where it has none
    };
    void split(std::uint32_t number);
    double changeAround(const Vec3d& centre, double radius) const;

    TriangleMesh cones_;
    MeshTree tree_;
    std::vector<Piece> pieces_;
    std::vector<Node> nodes_;
};

} // namespace vdbounce
