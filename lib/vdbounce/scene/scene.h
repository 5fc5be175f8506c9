// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/length.h"
#include "vdbounce/base/vector.h"
#include "vdbounce/contact/particle_contact.h"
#include "vdbounce/contact/step.h"
#include "vdbounce/field/field_options.h"
#include "vdbounce/scene/collider_spec.h"

#include <optional>
#include <string>
#include <vector>

namespace vdbounce {

/// A scene as its file states it, paths resolved. The defaults are those of the scene file.
struct Scene {
    double dt = 0.004;      ///< seconds, > 0
    int stepsPerFrame = 10; ///< >= 1
    int frames = 48;        ///< >= 0
    Vec3d gravity = Vec3d(0.0, -9.81, 0.0);

    std::string particleFile;
    Length radius;     ///< where the file carries none; in voxels: of the finest level set
    double mass = 1.0; ///< where the file carries none

    Scheme scheme = Scheme::CollideContact;
    int maxBounces = 3;
    Sweep sweep = Sweep::Auto;
    Length repulsionRange;          ///< in voxels: of the finest level set
    double repulsionStrength = 0.0; ///< world units / s^2, >= 0
    bool interact = false;          ///< particles collide with each other
    InteractOptions particles;      ///< and how

    FieldOptions accuracy;          ///< how level sets are looked up
    std::optional<Length> maxError; ///< in place of that the cheapest choice within it, > 0; see planAccuracy(). In
                                    ///< voxels: of the finest level set

    std::vector<ColliderSpec> colliders;

    std::string outputFile; ///< with #### for the frame: every `every`-th frame and the last; without: the last only;
                            ///< empty: none
    int every = 1;          ///< >= 1
    bool hits = false;      ///< write what is known of each particle's last collision
};

/// The colliders that particles meet: all but those that CSG takes as operands, in the scene's order.
std::vector<const ColliderSpec*> collidersMet(const Scene& scene);

/// A value that is out of range, and where it stands in the scene file: "time.dt", "collider[0].friction".
struct SceneFault {
    std::string path;
    double value;
    std::string remedy;
};
std::optional<SceneFault> findFault(const Scene& scene);

/// Throws UsageError for the first value out of range.
void validate(const Scene& scene);

/// `pattern` with its run of # replaced by the frame, padded to the run's length: "out.####.vdb", 7 -> "out.0007.vdb".
std::string framePath(const std::string& pattern, int frame);
bool hasFramePattern(const std::string& pattern);

} // namespace vdbounce
