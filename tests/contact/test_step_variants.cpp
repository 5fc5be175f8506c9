// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/moving_scene.h"
#include "support/random.h"
#include "support/step_options.h"

#include "vdbounce/contact/particle_pass.h"
#include "vdbounce/contact/step_needs.h"
#include "vdbounce/implicit/shapes.h"

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

struct VariantScene {
    const char* name;
    int variant; // that the pass must take
    std::vector<Collider> colliders;
    PassOptions options;
};

Collider ball(double friction, OnHit onHit = OnHit::Bounce)
{
    static const auto field =
        std::make_shared<const DistanceField>(levelSet(bandGrid(sphere(0.8), uniformTransform(0.05), 22)));
    return {"ball", field, 0.4, friction, onHit};
}

Collider box(double friction)
{
    return {"box", Shape(makeField(BoxShape{Vec3d(0, -0.9, 0), Vec3d(1.5, 0.2, 1.5)})), 0.4, friction};
}

PassOptions passOptions(Scheme scheme = Scheme::CollideContact, Sweep sweep = Sweep::Auto)
{
    PassOptions options;
    options.step.dt = 4e-3;
    options.step.scheme = scheme;
    options.step.sweep = sweep;
    options.defaults.radius = 0.02;
    return options;
}

std::vector<VariantScene> scenes()
{
    PassOptions repelled = passOptions();
    repelled.step.repulsion = {0.05, 20.0};
    PassOptions written = passOptions();
    written.hits = true;
    Collider spinning = ball(0.3);
    spinning.motion = moving(Vec3d(0.1, 0, 0), Vec3d(0, 2, 0.5));
    std::vector<VariantScene> all = {
        {"two that stand still", 2, {ball(0.3), box(0.3)}, passOptions()},
        {"one that keeps what touches it", 2, {ball(0.0, OnHit::Stick)}, passOptions()},
        {"one that deletes", 2, {ball(0.0, OnHit::Delete)}, passOptions()},
        {"repulsion", 2, {ball(0.3)}, repelled},
        {"hits", 2, {ball(0.3)}, written},
        {"one that moves", 3, {spinning}, passOptions()},
        {"one that moves and one that stands still", 3, {spinning, box(0.0)}, passOptions()},
    };
    for (const Scheme scheme : {Scheme::Once, Scheme::Iterate, Scheme::CollideContact}) {
        for (const Sweep sweep : {Sweep::Never, Sweep::Auto, Sweep::Always}) {
            all.push_back({"one without friction", 0, {ball(0.0)}, passOptions(scheme, sweep)});
            all.push_back({"one with friction", 1, {ball(0.3)}, passOptions(scheme, sweep)});
            all.push_back({"a formula", 1, {box(0.3)}, passOptions(scheme, sweep)});
        }
    }
    return all;
}

// Some begin inside, some are fast enough for sweeps.
Particles someParticles(Random& random)
{
    Particles particles;
    particles.resize(600);
    particles.ensureVelocity();
    for (std::size_t i = 0; i < particles.size(); ++i) {
        particles.position[i] = random.in(Box{Vec3d(-1, i % 20 == 0 ? 0.4 : 0.9, -1), Vec3d(1, 1.6, 1)});
        particles.velocity[i] = random.in(Box{Vec3d(-1, -30, -1), Vec3d(1, 1, 1)});
    }
    numberInOrder(particles);
    return particles;
}

struct Outcome {
    Particles particles;
    PassReport report;
};

Outcome run(Particles particles, const VariantScene& scene, bool whole)
{
    PassOptions options = scene.options;
    options.wholeStep = whole;
    const ColliderSet colliders(scene.colliders);
    const PassReport report = ParticlePass(particles, colliders, options).advance(300);
    return {particles, report};
}

void checkSame(const Outcome& a, const Outcome& b)
{
    CHECK(a.particles.position == b.particles.position);
    CHECK(a.particles.velocity == b.particles.velocity);
    CHECK(a.particles.stuckTo == b.particles.stuckTo);
    CHECK(a.particles.id == b.particles.id);
    CHECK(a.report.deleted == b.report.deleted);
    CHECK(a.report.tally.free == b.report.tally.free);
    CHECK(a.report.tally.contacts == b.report.tally.contacts);
    CHECK(a.report.tally.swept == b.report.tally.swept);
    CHECK(a.report.tally.unresolved == b.report.tally.unresolved);
    CHECK(a.report.tally.maxPenetration == b.report.tally.maxPenetration);
    CHECK(a.report.tally.impulse == b.report.tally.impulse);
    CHECK(a.report.tally.angularImpulse == b.report.tally.angularImpulse);
}

} // namespace

TEST_CASE("a step that leaves out what its scene cannot need changes no bit")
{
    VDBOUNCE_RANDOM(random);
    const Particles particles = someParticles(random);
    for (const VariantScene& scene : scenes()) {
        INFO(scene.name << ", scheme " << nameOf(scene.options.step.scheme) << ", sweep "
                        << nameOf(scene.options.step.sweep));
        const ColliderSet colliders(scene.colliders);
        CHECK(stepVariantFor(needsOf(colliders, scene.options.step, scene.options.hits)) == scene.variant);
        const Outcome bare = run(particles, scene, false);
        CHECK(bare.report.tally.contacts > 0);
        checkSame(bare, run(particles, scene, true));
    }
}

TEST_CASE("writing hits down, and asking for none, changes no bit of where particles go")
{
    VDBOUNCE_RANDOM(random);
    const Particles particles = someParticles(random);
    VariantScene scene{"", 1, {ball(0.3)}, passOptions()};
    const Outcome without = run(particles, scene, false);
    scene.options.hits = true;
    checkSame(without, run(particles, scene, false));
}

TEST_CASE("every step covers what it is taken for, and the bare ones do leave something out")
{
    for (int bits = 0; bits < 64; ++bits) {
        const StepNeeds needed{(bits & 1) != 0, (bits & 2) != 0,  (bits & 4) != 0,
                               (bits & 8) != 0, (bits & 16) != 0, (bits & 32) != 0};
        CHECK(kStepVariants[stepVariantFor(needed)].cover(needed));
    }
    // Without friction a particle on a slope goes on faster than with it.
    const ColliderSet rough({ball(0.5)});
    const PlacedColliders colliders(rough);
    MovingParticle bare = placed(Vec3d(0.5, 0.7, 0), Vec3d::Zero(), colliders, 0.02);
    MovingParticle whole = bare;
    StepTally tally(1);
    for (int s = 0; s < 200; ++s) {
        stepOfVariant(0)(bare, colliders, millisecond(), tally);
        stepOfVariant(kWholeStep)(whole, colliders, millisecond(), tally);
    }
    CHECK(bare.velocity.norm() > 1.2 * whole.velocity.norm());
}
