// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/particle_pass.h"

#include "vdbounce/base/parallel.h"

#include <cmath>

namespace vdbounce {
namespace {

// Particles a task: some tenths of a millisecond of work, and few enough that a thousand tasks share out evenly.
constexpr std::size_t kParticlesPerBlock = 1024;

constexpr int kStepsBetweenChecks = 4096; // about a millisecond of one particle's steps

MovingParticle load(const Particles& particles, std::size_t i, const ParticleDefaults& defaults)
{
    MovingParticle particle;
    particle.position = particles.position[i];
    particle.velocity = particles.velocity[i];
    particle.radius = particles.radius.empty() ? defaults.radius : particles.radius[i];
    particle.mass = particles.mass.empty() ? defaults.mass : particles.mass[i];
    return particle;
}

bool canBeStepped(const MovingParticle& particle)
{
    return particle.position.allFinite() && particle.velocity.allFinite() && particle.radius >= 0.0 &&
           std::isfinite(particle.radius) && particle.mass > 0.0 && std::isfinite(particle.mass);
}

struct Partial {
    StepTally tally;
    std::uint64_t rejected = 0;

    Partial& operator+=(const Partial& other)
    {
        tally += other.tally;
        rejected += other.rejected;
        return *this;
    }
};

} // namespace

PassReport advanceParticles(Particles& particles, const ColliderSet& colliders, const StepOptions& options,
                            const ParticleDefaults& defaults, int steps, Progress& progress)
{
    ProgressCounter counter(progress, particles.size());
    const Partial sum = reduceBlocks(particles.size(), kParticlesPerBlock, Partial{StepTally(colliders.size()), 0},
                                     [&](IndexRange range) {
                                         throwIfStopped(progress);
                                         Partial part{StepTally(colliders.size()), 0};
                                         for (std::size_t i = range.begin; i < range.end; ++i) {
                                             MovingParticle particle = load(particles, i, defaults);
                                             if (!canBeStepped(particle)) {
                                                 ++part.rejected;
                                                 continue;
                                             }
                                             settle(particle, colliders);
                                             for (int s = 0; s < steps; ++s)
                                                 step(particle, colliders, options, part.tally);
                                             particles.position[i] = particle.position;
                                             particles.velocity[i] = particle.velocity;
                                         }
                                         counter.add(range.end - range.begin);
                                         return part;
                                     });
    return {sum.tally, sum.rejected};
}

double totalEnergy(const Particles& particles, const ParticleDefaults& defaults, const Vec3d& gravity)
{
    return reduceBlocks(particles.size(), kParticlesPerBlock, 0.0, [&](IndexRange range) {
        double energy = 0.0;
        for (std::size_t i = range.begin; i < range.end; ++i) {
            const MovingParticle p = load(particles, i, defaults);
            if (canBeStepped(p)) energy += p.mass * (0.5 * p.velocity.squaredNorm() - gravity.dot(p.position));
        }
        return energy;
    });
}

} // namespace vdbounce
