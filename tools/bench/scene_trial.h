// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/particles/particles.h"
#include "vdbounce/scene/scene.h"
#include "vdbounce/scene/scene_colliders.h"

#include <cstddef>
#include <vector>

namespace vdbounce::bench {

/// A scene's particles as they begin, some of them, with a radius and a mass each; and for how long they are followed.
struct SceneStart {
    Particles particles;
    int frames = 0; ///< >= 1
};

/// At most `most` particles, evenly picked from the scene's file; `frames` of its frames, or of its first second where
/// that is 0, but no more than it has.
SceneStart startOf(const Scene& scene, const ColliderSet& colliders, std::size_t most, int frames);

/// What became of them. Each particle has the same place as in the start.
struct SceneOutcome {
    Particles particles;             ///< at the end
    std::vector<HitRecord> firstHit; ///< of each particle; count 0 where it hit nothing
    double deepest = 0.0;            ///< penetration of any particle in any step, world units
    double energy = 0.0;             ///< of all particles at the end
    double mostKinetic = 0.0;        ///< energy of all particles together, at the start or the end of any step
};

/// Runs the scene with its own settings, from the start.
SceneOutcome outcomeOf(const Scene& scene, SceneColliders& colliders, const SceneStart& start, Progress& progress);

/// The same on one thread, without looking at anything in between: nanoseconds a particle and step.
double timeOf(const Scene& scene, SceneColliders& colliders, const SceneStart& start, Progress& progress);

} // namespace vdbounce::bench
