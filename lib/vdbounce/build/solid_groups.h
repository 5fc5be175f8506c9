// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/build/column_crossings.h"
#include "vdbounce/build/hole_caps.h"
#include "vdbounce/build/mesh_topology.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace vdbounce {

/// One body, or part of one, whose inside is told by itself.
struct SolidGroup {
    enum class Rule {
        Winding, ///< its faces wind around a point
        Parity,  ///< a line from the point crosses it an odd number of times: for faces that cannot be made to agree
        Open,    ///< it winds around a point more than half, holes and all: the fast winding number
    };
    Rule rule = Rule::Winding;
    int weight = 1; ///< a point is inside of all where the weights of the groups that hold it add up to more than zero;
                    ///< -1 for what takes away: the walls of cavities
    double volume = 0.0; ///< world; negative where it faces inwards

    /// For Open groups: the caps over its holes, and whether they are taken for walls; else their share of the winding
    /// number is taken off again.
    std::shared_ptr<const HoleCaps> caps;
    bool capsAreWalls = false;

    /// True when the group holds a point at which crossings add up to `count`.
    bool holds(int count) const { return rule == Rule::Parity ? (count & 1) != 0 : count != 0; }
};

/// A mesh closed by caps, its triangles in groups.
struct SolidGroups {
    ClosedMesh mesh;
    std::size_t ownTriangles = 0; ///< of the mesh itself, the first ones; the others are caps
    std::vector<SolidGroup> groups;
};

/// Takes the triangles out of `topology`, whose points are `points`, which must outlive the result.
///
/// Closes the holes of the components in `solid` (a flag each) and puts those that are open, but for those that nearly
/// are closed, into one group; each of the others is its own.
///
/// Method: a cone from the middle of each hole's rim over its edges closes it, whatever its shape. Crossings then count
/// whole windings. Where the cones lie about where the open mesh's winding number is a half (Jacobson et al. 2013) they
/// are taken for walls. Elsewhere the cones' own winding number is taken off again (the fast winding number of Barill
/// et al. 2018, of the cones alone): together exactly that of the open mesh.
SolidGroups groupSolids(MeshTopology topology, const std::vector<Vec3d>& points, const std::vector<char>& solid);

/// Finds which groups are walls of cavities and gives them weight -1: those that lie within an odd number of others,
/// touching none of them, and those that face inwards and cut into others. Returns how many lie within others but face
/// the same way as the one around them: those only where columns along all three axes say so.
std::size_t findCavities(SolidGroups& solids, const std::vector<Crossing>& crossings, const LinearTransform& transform,
                         const Progress& progress);

} // namespace vdbounce
