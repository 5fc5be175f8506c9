// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/io/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vdbounce {

/// The sides of triangles, grouped by the edge they lie on. Side 3 t + k runs from corner k of triangle t to the next.
class MeshEdges {
public:
    /// One triangle's side on an edge.
    struct Side {
        std::uint32_t high; ///< the edge's point of larger number; `low` is the group's
        std::uint32_t side;
    };

    /// Triangles for which `use` is false are passed over.
    MeshEdges(const std::vector<TriangleMesh::Triangle>& triangles, std::size_t pointCount,
              const std::vector<char>& use);

    /// Calls body(low, first, last) with the sides of each edge, in the order of the points' numbers and of the sides.
    template <class Body> void forEachEdge(const Body& body) const
    {
        for (std::uint32_t low = 0; low + 1 < begin_.size(); ++low) {
            for (std::uint32_t first = begin_[low]; first < begin_[low + 1];) {
                std::uint32_t last = first + 1;
                while (last < begin_[low + 1] && sides_[last].high == sides_[first].high) ++last;
                body(low, sides_.data() + first, sides_.data() + last);
                first = last;
            }
        }
    }

private:
    std::vector<std::uint32_t> begin_; // of each low point's sides
    std::vector<Side> sides_;
};

} // namespace vdbounce
