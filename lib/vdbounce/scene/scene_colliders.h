// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/collider.h"
#include "vdbounce/contact/particle_pass.h"
#include "vdbounce/particles/particles.h"
#include "vdbounce/scene/scene.h"

#include <map>
#include <memory>
#include <string>

namespace vdbounce {

/// The colliders of a scene, read from their files. A file that several colliders name is read once.
class SceneColliders {
public:
    /// Reads what holds for all frames. `scene` must outlive this.
    explicit SceneColliders(const Scene& scene);

    /// Some collider's form changes from frame to frame.
    bool deforming() const { return deforming_; }

    /// The colliders on the way from the frame before to `frame`. Of sequences the two files are read that are needed;
    /// throws InputError where one is missing.
    ColliderSet onTheWayTo(int frame);

    /// Throws InputError when a particle is too large for the narrow band of a level set, see band_needs.h. Asks the
    /// level sets of the last frame.
    void requireBandsForRadius(const ColliderSet& colliders, const Particles& particles,
                               const ParticleDefaults& defaults) const;

    /// Of the level sets that are held now: of sequences two frames'.
    std::size_t memoryBytes() const;

private:
    using FieldPtr = std::shared_ptr<const DistanceField>;
    struct Moment {
        FieldPtr field;
        std::shared_ptr<const VelocityField> velocity;
    };

    Moment momentOf(const std::string& sequence, int frame);
    Shape shapeOf(const ColliderSpec& spec, int frame);
    Shape deformingShape(const ColliderSpec& spec, int frame);
    Shape csgOf(const ColliderSpec& spec, int frame);
    const ColliderSpec& specOf(const std::string& name) const;

    const Scene& scene_;
    std::map<std::string, FieldPtr> fields_;                                   // by file
    std::map<std::string, std::shared_ptr<const ImplicitField>> heightfields_; // by collider
    std::map<std::string, std::map<int, Moment>> moments_;                     // by sequence, the last two frames
    bool deforming_ = false;
};

/// What particles have that carry no attribute of their own; a radius in voxels needs the colliders.
ParticleDefaults particleDefaults(const Scene& scene, const ColliderSet& colliders);

/// The options of a scene's steps; lengths in voxels need the colliders.
StepOptions stepOptions(const Scene& scene, const ColliderSet& colliders);

/// And of its passes.
PassOptions passOptions(const Scene& scene, const ColliderSet& colliders, const ParticleDefaults& defaults);

} // namespace vdbounce
