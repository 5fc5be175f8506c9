// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/build/mesh_tree.h"
#include "vdbounce/build/sign_method.h"
#include "vdbounce/build/solid_groups.h"
#include "vdbounce/field/linear_transform.h"

#include <memory>
#include <vector>

namespace vdbounce {

/// The distance to a mesh and its sign at any point, found by searching in double precision: slow, and independent of
/// how a level set is made but for which components are bodies, cavities and sheets. Safe to use from any number of
/// threads.
class MeshOracle {
public:
    /// `sign` as it was asked for: Auto treats each component by itself, as seen on the voxels of `transform`.
    /// `halfThickness` (world) is that of sheets.
    MeshOracle(const TriangleMesh& mesh, SignMethod sign, const LinearTransform& transform, double halfThickness);

    /// World distance to the nearest triangle of a body; infinite where there is none.
    double bodyDistance(const Vec3d& p) const;

    /// World distance to the surface of the nearest sheet, negative within it; infinite where there is none.
    double sheetDistance(const Vec3d& p) const;

    /// True when p is inside a body. Where Flood was asked for, what lies in cavities is left out.
    bool inBody(const Vec3d& p) const;

private:
    // A mesh and its tree.
    struct Searchable {
        TriangleMesh mesh;
        MeshTree tree;
        explicit Searchable(TriangleMesh m) : mesh(std::move(m)), tree(mesh) {}
    };
    struct Body {
        bool byParity;
        int weight;
        Box box;
        std::unique_ptr<const Searchable> surface;
        bool holds(const Vec3d& p) const;
    };
    void addBodies(const SolidGroups& solids);

    double halfThickness_;
    std::unique_ptr<const Searchable> solid_;
    std::unique_ptr<const Searchable> sheet_;
    std::vector<Body> bodies_;
};

} // namespace vdbounce
