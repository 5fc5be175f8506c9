// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/base/parallel.h"
#include "vdbounce/contact/particle_pass.h"

#include <algorithm>

/// @file
/// Steps of particles that see each other, by what they do to colliders or directly: all through one step before the
/// next.

namespace vdbounce {
namespace {

// Rounds of contact among particles and with colliders a step at most. What weighs on a particle comes down to it by
// some layers a round: in a heap of 15 layers, 8 rounds leave overlaps of 1.5 % of a diameter and let it creep, 24
// leave 0.2 % and it stands.
constexpr int kContactRounds = 24;

struct Counts {
    std::vector<std::uint64_t> values;
    Counts& operator+=(const Counts& other)
    {
        for (std::size_t i = 0; i < values.size(); ++i) values[i] += other.values[i];
        return *this;
    }
};

} // namespace

void ParticlePass::gatherSpheres()
{
    const std::size_t count = particles_.size();
    spheres_.radius.assign(count, 0.0);
    spheres_.inverseMass.assign(count, 0.0);
    for (std::size_t i = 0; i < count; ++i) {
        if (skipped_[i] != 0) continue;
        spheres_.radius[i] = particles_.radius.empty() ? options_.defaults.radius : particles_.radius[i];
        spheres_.inverseMass[i] = 1.0 / (particles_.mass.empty() ? options_.defaults.mass : particles_.mass[i]);
    }
}

StepTally ParticlePass::stepAll(const PlacedColliders& placed)
{
    return reduceBlocks(particles_.size(), kParticlesPerBlock, StepTally(colliders_->size()), [&](IndexRange range) {
        StepTally part(colliders_->size());
        for (std::size_t i = range.begin; i < range.end; ++i) {
            if (skipped_[i] != 0) continue;
            MovingParticle particle = load(i);
            step(particle, placed, options_.step, part);
            store(i, particle);
        }
        return part;
    });
}

// How many particles would push each body in this step: each then meets that share of its mass.
void ParticlePass::shareBodies(PlacedColliders& placed)
{
    const Counts none{std::vector<std::uint64_t>(bodies_.size(), 0)};
    const Counts sum = reduceBlocks(particles_.size(), kParticlesPerBlock, none, [&](IndexRange range) {
        Counts part = none;
        StepTally trial(bodies_.size());
        for (std::size_t i = range.begin; i < range.end; ++i) {
            if (skipped_[i] != 0) continue;
            MovingParticle particle = load(i);
            particle.hits = nullptr;
            for (Vec3d& impulse : trial.impulse) impulse.setZero();
            step(particle, placed, options_.step, trial);
            for (std::size_t b = 0; b < bodies_.size(); ++b)
                part.values[b] += bodies_[b] && !trial.impulse[b].isZero(0.0) ? 1 : 0;
        }
        return part;
    });
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        if (!bodies_[b]) continue;
        RigidBody moved = *bodies_[b];
        moved.move(options_.step.dt);
        placed.share(b, BodyShare(moved, double(std::max<std::uint64_t>(1, sum.values[b]))));
    }
}

// What other particles moved meets the colliders once more.
StepTally ParticlePass::answerMoved(const PlacedColliders& placed, const std::vector<Vec3d>& starts,
                                    std::vector<Vec3d>& ends, std::vector<Vec3d>& endVelocities,
                                    const std::vector<std::uint8_t>& changed)
{
    return reduceBlocks(particles_.size(), kParticlesPerBlock, StepTally(colliders_->size()), [&](IndexRange range) {
        StepTally part(colliders_->size());
        for (std::size_t i = range.begin; i < range.end; ++i) {
            if (changed[i] == 0) continue;
            MovingParticle particle = load(i);
            moveAgain(particle, starts[i], ends[i], endVelocities[i], placed, options_.step, part);
            store(i, particle);
            ends[i] = particle.position;
            endVelocities[i] = particle.velocity;
        }
        return part;
    });
}

// Particles that were removed touch nothing more, and those that stick are not moved by others.
void ParticlePass::holdWhatSticks()
{
    spheres_.skipped = skipped_;
    for (std::size_t i = 0; i < particles_.stuckTo.size(); ++i) {
        if (particles_.stuckTo[i] != MovingParticle::kNotStuck) spheres_.inverseMass[i] = 0.0;
    }
}

// The velocity that bodies have got in this step so far.
void ParticlePass::pushBodies(PlacedColliders& placed, const StepTally& tally) const
{
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        if (!bodies_[b]) continue;
        RigidBody moved = *bodies_[b];
        moved.move(options_.step.dt);
        moved.push(tally.impulse[b], tally.angularImpulse[b]);
        placed.setVelocity(b, moved.velocity());
    }
}

StepTally ParticlePass::stepInteracting(PlacedColliders& placed)
{
    const double dt = options_.step.dt;
    holdWhatSticks();
    const ParticleContact contact(spheres_, particles_.position, particles_.velocity, dt, options_.particles);
    contact.collide(particles_.position, particles_.velocity, dt);
    const std::vector<Vec3d> starts = particles_.position;
    StepTally tally = stepAll(placed);
    holdWhatSticks();
    std::vector<Vec3d> ends = particles_.position;
    std::vector<Vec3d> endVelocities = particles_.velocity;
    std::vector<std::uint8_t> changed;
    for (int round = 0; round < kContactRounds; ++round) {
        if (!contact.rest(starts, ends, endVelocities, changed)) break;
        pushBodies(placed, tally);
        tally += answerMoved(placed, starts, ends, endVelocities, changed);
    }
    return tally;
}

StepTally ParticlePass::advanceTogether(int steps, Progress& progress)
{
    StepTally total(colliders_->size());
    ProgressCounter counter(progress, static_cast<std::uint64_t>(steps));
    for (int s = 0; s < steps; ++s) {
        throwIfStopped(progress);
        for (auto& body : bodies_) {
            if (body) body->accelerate(options_.step.gravity, 0.5 * options_.step.dt);
        }
        PlacedColliders placed = placedAt(step_ + static_cast<std::uint64_t>(s), options_.step.dt);
        if (colliders_->anyFree()) shareBodies(placed);
        const StepTally tally = options_.interact ? stepInteracting(placed) : stepAll(placed);
        for (std::size_t b = 0; b < bodies_.size(); ++b) {
            if (!bodies_[b]) continue;
            bodies_[b]->move(options_.step.dt);
            bodies_[b]->push(tally.impulse[b], tally.angularImpulse[b]);
            // Half of the weight before and half after: so bodies fall as particles do.
            bodies_[b]->accelerate(options_.step.gravity, 0.5 * options_.step.dt);
        }
        total += tally;
        counter.add(1);
    }
    return total;
}

} // namespace vdbounce
