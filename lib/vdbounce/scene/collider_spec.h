// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/length.h"
#include "vdbounce/base/vector.h"
#include "vdbounce/contact/collider.h"
#include "vdbounce/contact/motion.h"
#include "vdbounce/implicit/blobs.h"
#include "vdbounce/implicit/csg_operation.h"
#include "vdbounce/implicit/height_grid.h"
#include "vdbounce/implicit/shapes.h"

#include <optional>
#include <string>
#include <vector>

namespace vdbounce {

/// One `[[collider]]` of a scene: a form and how it answers.
struct ColliderSpec {
    /// Other colliders of the scene, combined. Those then no longer collide themselves.
    struct Csg {
        CsgOperation operation = CsgOperation::Union;
        std::vector<std::string> of; ///< names of colliders
        Length blend;                ///< rounds edges; in voxels: of the finest level set among them
    };
    /// The solid under a map of heights.
    struct Heightfield {
        std::string file; ///< .png, .csv or .txt
        HeightfieldOptions place;
    };
    /// The surface of particles, made a level set when the scene is read.
    struct Blobs {
        std::string file; ///< of particles
        BlobOptions options;
    };
    /// Of a collider that particles move. What is left out is that of a body of even density.
    struct Body {
        double mass = 1.0;            ///< > 0
        std::optional<Vec3d> centre;  ///< of mass, world units, as in the file
        std::optional<Vec3d> inertia; ///< principal moments about the centre, along the axes as in the file; > 0
    };

    std::string name;
    // Exactly one of these.
    std::string file;     ///< a level set
    std::string sequence; ///< a level set a frame, #### for the frame; interpolated in between
    std::optional<ShapeFormula> formula;
    std::optional<Heightfield> heightfield;
    std::optional<Blobs> blobs;
    std::optional<Csg> csg;

    double restitution = 0.3; ///< 0 to 1
    double friction = 0.5;    ///< >= 0
    OnHit onHit = OnHit::Bounce;
    /// None, constant or through keys. With `body` none or constant: the velocities at the start.
    Motion motion;
    std::optional<Body> body; ///< present: it moves by gravity and by what hits it
};

} // namespace vdbounce
