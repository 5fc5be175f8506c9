// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/particle_pass.h"

#include "vdbounce/base/parallel.h"

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

// The clearance of what does not move by itself.
constexpr double kNeverFree = -1.0;

MovingParticle fromArrays(const Particles& particles, std::size_t i, const ParticleDefaults& defaults)
{
    MovingParticle particle;
    particle.position = particles.position[i];
    particle.velocity = particles.velocity.empty() ? Vec3d(Vec3d::Zero()) : particles.velocity[i];
    particle.radius = particles.radius.empty() ? defaults.radius : particles.radius[i];
    particle.mass = particles.mass.empty() ? defaults.mass : particles.mass[i];
    return particle;
}

bool canBeStepped(const MovingParticle& particle)
{
    return particle.position.allFinite() && particle.velocity.allFinite() && particle.radius >= 0.0 &&
           std::isfinite(particle.radius) && particle.mass > 0.0 && std::isfinite(particle.mass);
}

bool anyOnHit(const ColliderSet& colliders, OnHit onHit)
{
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        if (colliders[i].onHit == onHit) return true;
    }
    return false;
}

} // namespace

ParticlePass::ParticlePass(Particles& particles, const ColliderSet& colliders, const PassOptions& options)
    : particles_(particles), colliders_(&colliders), options_(options), step_(options.firstStep),
      clearance_(particles.size(), kNeverFree), inside_(particles.size(), 0), touching_(particles.size(), 0),
      skipped_(particles.size(), 0)
{
    particles_.ensureVelocity();
    if (options.hits && particles_.hits.empty()) particles_.hits.resize(particles_.size());
    if (anyOnHit(colliders, OnHit::Stick) && particles_.stuckTo.empty())
        particles_.stuckTo.assign(particles_.size(), MovingParticle::kNotStuck);
    std::fill(particles_.rejected.begin(), particles_.rejected.end(), std::uint8_t(0));
    for (std::size_t i = 0; i < particles_.size(); ++i) {
        const bool sticksToSomething = particles_.stuckTo.empty() || particles_.stuckTo[i] < int(colliders.size());
        if (sticksToSomething && canBeStepped(fromArrays(particles_, i, options.defaults))) continue;
        skipped_[i] = 1;
        if (particles_.rejected.empty()) particles_.rejected.assign(particles_.size(), 0);
        particles_.rejected[i] = 1;
    }
    if (options_.interact) gatherSpheres();
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        bodies_.push_back(colliders[i].body ? std::optional<RigidBody>(*colliders[i].body) : std::nullopt);
    }
}

void ParticlePass::setColliders(const ColliderSet& colliders)
{
    colliders_ = &colliders;
    settled_ = false;
}

MovingParticle ParticlePass::load(std::size_t i)
{
    MovingParticle particle = fromArrays(particles_, i, options_.defaults);
    particle.clearance = clearance_[i];
    particle.inside = inside_[i] != 0;
    particle.touching = touching_[i] != 0;
    if (!particles_.stuckTo.empty()) particle.stuckTo = particles_.stuckTo[i];
    if (options_.hits) particle.hits = &particles_.hits[i];
    return particle;
}

void ParticlePass::store(std::size_t i, const MovingParticle& particle)
{
    particles_.position[i] = particle.position;
    particles_.velocity[i] = particle.velocity;
    clearance_[i] = particle.clearance;
    inside_[i] = particle.inside ? 1 : 0;
    touching_[i] = particle.touching ? 1 : 0;
    if (!particles_.stuckTo.empty()) particles_.stuckTo[i] = particle.stuckTo;
    if (particle.deleted) skipped_[i] = 1;
    if (particle.deleted || particle.stuckTo != MovingParticle::kNotStuck) clearance_[i] = kNeverFree;
}

// The colliders during one step; without a length, as they are when it begins.
PlacedColliders ParticlePass::placedAt(std::uint64_t step, double dt) const
{
    PlacedColliders placed(*colliders_, timeOf(step), dt);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (!bodies_[i]) continue;
        RigidBody moved = *bodies_[i];
        moved.move(dt);
        placed.place(i, bodies_[i]->pose(), moved.pose(), moved.velocity());
        placed.share(i, BodyShare(moved, 1.0));
    }
    return placed;
}

void ParticlePass::settleAll()
{
    const PlacedColliders placed = placedAt(step_, 0.0);
    forEachIndex(particles_.size(), kParticlesPerBlock, [&](std::size_t i) {
        if (skipped_[i] != 0) return;
        MovingParticle particle = load(i);
        settle(particle, placed);
        store(i, particle);
    });
    settled_ = true;
}

std::uint64_t ParticlePass::removeDeleted()
{
    if (!anyOnHit(*colliders_, OnHit::Delete)) return 0;
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < skipped_.size(); ++i) {
        const bool rejected = !particles_.rejected.empty() && particles_.rejected[i] != 0;
        if (skipped_[i] == 0 || rejected) kept.push_back(i);
    }
    const std::uint64_t deleted = skipped_.size() - kept.size();
    if (deleted == 0) return 0;
    for (std::size_t k = 0; k < kept.size(); ++k) {
        clearance_[k] = clearance_[kept[k]];
        inside_[k] = inside_[kept[k]];
        touching_[k] = touching_[kept[k]];
        skipped_[k] = skipped_[kept[k]];
    }
    clearance_.resize(kept.size());
    for (auto* flags : {&inside_, &touching_, &skipped_}) flags->resize(kept.size());
    particles_ = reordered(particles_, kept);
    if (options_.interact) gatherSpheres();
    return deleted;
}

PassReport ParticlePass::advance(int steps, Progress& progress)
{
    if (!settled_) settleAll();
    PassReport report;
    report.tally =
        colliders_->anyFree() || options_.interact ? advanceTogether(steps, progress) : advanceApart(steps, progress);
    step_ += static_cast<std::uint64_t>(steps);
    report.deleted = removeDeleted();
    report.rejected =
        static_cast<std::uint64_t>(std::count(particles_.rejected.begin(), particles_.rejected.end(), std::uint8_t(1)));
    return report;
}

PassReport advanceParticles(Particles& particles, const ColliderSet& colliders, const StepOptions& options,
                            const ParticleDefaults& defaults, int steps, Progress& progress)
{
    PassOptions pass;
    pass.step = options;
    pass.defaults = defaults;
    return ParticlePass(particles, colliders, pass).advance(steps, progress);
}

double totalEnergy(const Particles& particles, const ParticleDefaults& defaults, const Vec3d& gravity)
{
    return reduceBlocks(particles.size(), kParticlesPerBlock, 0.0, [&](IndexRange range) {
        double energy = 0.0;
        for (std::size_t i = range.begin; i < range.end; ++i) {
            const MovingParticle p = fromArrays(particles, i, defaults);
            if (canBeStepped(p)) energy += p.mass * (0.5 * p.velocity.squaredNorm() - gravity.dot(p.position));
        }
        return energy;
    });
}

} // namespace vdbounce
