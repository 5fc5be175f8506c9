// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/build/mesh_topology.h"
#include "vdbounce/build/sign_method.h"

#include <cstddef>
#include <string>
#include <vector>

namespace vdbounce {

/// Which sign method each component of a mesh is to have.
struct ComponentSigns {
    std::vector<SignMethod> method;           ///< of each component: Winding, Parity, Flood or Unsigned
    std::vector<SignChoice> choices;          ///< the same in words, by method and reason
    SignMethod overall = SignMethod::Winding; ///< of most of the surface

    /// A flag for each component, 1 where its method is `wanted`.
    std::vector<char> having(SignMethod wanted) const;

    /// True when the side of some component can only be told by rays, one point at a time: it is open, and its method
    /// parity.
    bool needsRays(const MeshTopology& topology) const;
};

/// Chooses for each connected component:
/// closed, or closed once its faces agree: winding numbers, counted; closed but of faces that cannot agree (a Klein
/// bottle): parity; with holes of less than a twentieth of its area: winding numbers, holes and all; else it is asked
/// half a voxel to either side of its surface: where winding numbers tell the sides apart, they decide; where five
/// rays agree on it, parity does; where nothing does it encloses nothing and becomes a sheet (unsigned).
ComponentSigns chooseSigns(const MeshTopology& topology, const std::vector<Vec3d>& points, double voxelSize,
                           const Progress& progress = Progress::none());

} // namespace vdbounce
