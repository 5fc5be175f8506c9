// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/contact/particle_contact.h"
#include "vdbounce/contact/step.h"
#include "vdbounce/particles/particles.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace vdbounce {

/// Particles a task: some tenths of a millisecond of work, and few enough that a thousand tasks share out evenly.
constexpr std::size_t kParticlesPerBlock = 1024;

/// What a particle has whose file carries no such attribute.
struct ParticleDefaults {
    double radius = 0.0; ///< world units, >= 0
    double mass = 1.0;   ///< > 0
};

/// What one pass did.
struct PassReport {
    StepTally tally;
    std::uint64_t rejected = 0; ///< particles left as they came: not finite, or a negative radius or mass
    std::uint64_t deleted = 0;  ///< removed by what they hit
};

struct PassOptions {
    StepOptions step;
    ParticleDefaults defaults;
    std::uint64_t firstStep = 0; ///< steps that lie before; times of motions are the number of the step times dt
    bool hits = false;           ///< keep Particles::hits
    bool wholeStep = false;      ///< look also at what the scene cannot need: the same results, for comparison
    bool interact = false;       ///< particles collide with each other
    InteractOptions particles;   ///< how, if so
};

/// Advances a set of particles, in parallel, and remembers between calls what it knows of them: how far each can move
/// before it could touch anything.
///
/// Where particles neither move colliders nor collide with each other they do not see each other, so each is taken
/// through all steps of a call while it and the voxels around it are in the cache. Results, sums included, have the
/// same bits for any number of threads and any split of the steps into calls.
///
///     ParticlePass pass(particles, colliders, options);
///     for (int frame = 0; frame < 48; ++frame) pass.advance(10);
class ParticlePass {
public:
    /// Holds on to both; they must outlive it, and particles may be changed by it only. Adds velocities where there are
    /// none.
    ParticlePass(Particles& particles, const ColliderSet& colliders, const PassOptions& options);

    /// Goes on with other colliders: as many, in the same order, such as the next forms of deforming ones.
    void setColliders(const ColliderSet& colliders);

    /// Tells `progress` of particle steps done. Throws Interrupted, with some particles advanced and others not.
    PassReport advance(int steps, Progress& progress = Progress::none());

    /// The bodies of those colliders that particles move, in the order of the colliders; nothing for the others.
    const std::vector<std::optional<RigidBody>>& bodies() const { return bodies_; }

private:
    struct Apart;
    class ApartBlock;

    double timeOf(std::uint64_t step) const { return double(step) * options_.step.dt; }
    MovingParticle load(std::size_t i);
    void store(std::size_t i, const MovingParticle& particle);
    void settleAll();
    PlacedColliders placedAt(std::uint64_t step, double dt) const;
    StepTally advanceApart(int steps, Progress& progress);
    StepTally advanceTogether(int steps, Progress& progress);
    StepTally stepAll(const PlacedColliders& placed);
    void shareBodies(PlacedColliders& placed);
    void gatherSpheres();
    void holdWhatSticks();
    void pushBodies(PlacedColliders& placed, const StepTally& tally) const;
    StepTally stepInteracting(PlacedColliders& placed);
    StepTally answerMoved(const PlacedColliders& placed, const std::vector<Vec3d>& starts, std::vector<Vec3d>& ends,
                          std::vector<Vec3d>& endVelocities, const std::vector<std::uint8_t>& changed);
    std::uint64_t removeDeleted();

    Particles& particles_;
    const ColliderSet* colliders_;
    PassOptions options_;
    std::uint64_t step_;
    // What is kept of a particle between steps.
    std::vector<double> clearance_; // negative: not to be flown freely
    std::vector<std::uint8_t> inside_;
    std::vector<std::uint8_t> touching_;
    std::vector<std::uint8_t> skipped_; // deleted or rejected
    std::vector<std::optional<RigidBody>> bodies_;
    Spheres spheres_;      // of particles that collide with each other
    bool settled_ = false; // what is kept is right for these colliders
};

/// The same in one call, for particles of which nothing is known yet.
PassReport advanceParticles(Particles& particles, const ColliderSet& colliders, const StepOptions& options,
                            const ParticleDefaults& defaults, int steps, Progress& progress = Progress::none());

/// Kinetic plus potential energy of all particles that can be stepped, m (v^2/2 - g.x), summed in fixed order.
double totalEnergy(const Particles& particles, const ParticleDefaults& defaults, const Vec3d& gravity);

} // namespace vdbounce
