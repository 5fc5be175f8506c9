// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/grounds.h"
#include "support/one_particle.h"
#include "support/random.h"

#include "vdbounce/contact/particle_pass.h"
#include "vdbounce/contact/step.h"

#include <cmath>

#include <tbb/global_control.h>

using namespace vdbounce;
using namespace vdbounce::test;

TEST_CASE("a resting particle stays where it is, to the bit")
{
    for (const Ground& ground : grounds(Vec3d(0.1, 1, -0.05))) {
        INFO(ground.name);
        const StillColliders colliders = single(ground, 0.5, 0.6);
        StepOptions options;
        MovingParticle particle = placed(Vec3d(0.1, 0.2, 0.1), Vec3d::Zero(), colliders, 0.03);
        StepTally tally(1);
        for (int s = 0; s < 3000; ++s) step(particle, colliders, options, tally);
        const Vec3d resting = particle.position;
        for (int s = 0; s < 20000; ++s) step(particle, colliders, options, tally);
        CHECK(particle.position == resting);
        CHECK(particle.velocity == Vec3d::Zero());
        CHECK(tally.unresolved == 0);
    }
}

TEST_CASE("what starts outside ends outside, and energy never grows, in random scenes")
{
    VDBOUNCE_RANDOM(random);
    for (int scene = 0; scene < 30; ++scene) {
        std::vector<Collider> list;
        const double e = random.uniform(0, 1);
        const double mu = random.uniform(0, 1);
        for (int i = 0; i < 3; ++i) {
            const Vec3d centre = random.in(Box{Vec3d::Constant(-0.4), Vec3d::Constant(0.4)});
            const Phi phi = sphere(random.uniform(0.2, 0.5), centre);
            list.push_back({"ball" + std::to_string(i),
                            std::make_shared<const DistanceField>(levelSet(bandGrid(phi, uniformTransform(0.05), 22))),
                            e, mu});
        }
        list.push_back({"floor", PlaneField(Vec3d(0, -0.5, 0), Vec3d(random.uniform(-0.3, 0.3), 1, 0)), e, mu});
        const StillColliders colliders(std::move(list));
        StepOptions options;
        options.dt = std::pow(10.0, random.uniform(-3.5, -1.5));
        for (int i = 0; i < 60; ++i) {
            const double radius = i % 3 == 0 ? 0.0 : random.uniform(0, 0.08);
            MovingParticle particle = placed(random.in(Box{Vec3d(-0.8, -0.3, -0.8), Vec3d(0.8, 1.2, 0.8)}),
                                             random.uniform(0, 3) * random.direction(), colliders, radius);
            if (particle.inside) continue;
            StepTally tally(colliders.size());
            double before = energy(particle, options.gravity);
            for (int s = 0; s < 300; ++s) {
                step(particle, colliders, options, tally);
                INFO("scene " << scene << ", particle " << i << ", step " << s << ", dt " << options.dt);
                REQUIRE(particle.position.allFinite());
                REQUIRE(colliders.probe(particle.position, radius).gap >= 0.0);
                const double now = energy(particle, options.gravity);
                REQUIRE(now <= before + 1e-12 * (1.0 + std::abs(before)));
                before = now;
            }
        }
    }
}

TEST_CASE("a particle that starts inside comes out and does not shoot off")
{
    const StillColliders colliders(
        {{"ball",
          std::make_shared<const DistanceField>(levelSet(bandGrid(sphere(0.8), uniformTransform(0.05), 22, 5.0))), 0.9,
          0.1}});
    StepOptions options;
    options.gravity = Vec3d::Zero();
    MovingParticle particle = placed(Vec3d(0.5, 0.45, 0), Vec3d(0.1, 0, 0), colliders);
    REQUIRE(particle.inside);
    StepTally tally(1);
    for (int s = 0; s < 200; ++s) step(particle, colliders, options, tally);
    CHECK_FALSE(particle.inside);
    CHECK(particle.velocity.norm() <= 0.1);
    CHECK(tally.unresolved > 0);
    CHECK(tally.maxPenetration > 0.0);
}

TEST_CASE("a particle deep inside, where the band has no gradient, comes out by the short way")
{
    VDBOUNCE_RANDOM(random);
    const Phi phi = sphere(1.5); // 30 voxels
    const StillColliders colliders(
        {{"ball", std::make_shared<const DistanceField>(levelSet(bandGrid(phi, uniformTransform(0.05), 40))), 0.3,
          0.5}});
    StepOptions options;
    options.gravity = Vec3d::Zero();
    for (int i = 0; i < 200; ++i) {
        const Vec3d start = 1.4 * random.uniform(0, 1) * random.direction();
        MovingParticle particle = placed(start, random.direction(), colliders, 0.02);
        REQUIRE(particle.inside);
        StepTally tally(1);
        int steps = 0;
        for (; particle.inside && steps < 200; ++steps) step(particle, colliders, options, tally);
        INFO("from " << start.transpose() << " to " << particle.position.transpose() << " in " << steps << " steps");
        REQUIRE_FALSE(particle.inside);
        // Not farther than it must, but for the few voxels by which the nearest place outside is not the nearest.
        REQUIRE((particle.position - start).norm() < -phi(start) + 0.25);
    }
}

TEST_CASE("a collider takes the opposite impulse")
{
    const StillColliders colliders = single(grounds(kUp)[0], 0.5, 0.3);
    StepOptions options;
    options.dt = 1e-3;
    MovingParticle particle = placed(Vec3d(0, 0.5, 0), Vec3d(1, 0, 0), colliders);
    particle.mass = 3.0;
    StepTally tally(1);
    const int steps = 1000;
    for (int s = 0; s < steps; ++s) step(particle, colliders, options, tally);
    const Vec3d change = 3.0 * (particle.velocity - Vec3d(1, 0, 0));
    const Vec3d byGravity = 3.0 * steps * options.dt * options.gravity;
    CHECK((change - byGravity + tally.impulse[0]).norm() < 1e-10);
}

TEST_CASE("skipping lookups by clearance changes no bit")
{
    VDBOUNCE_RANDOM(random);
    const StillColliders colliders(
        {{"ball", std::make_shared<const DistanceField>(levelSet(bandGrid(sphere(0.8), uniformTransform(0.05), 22))),
          0.5, 0.3},
         {"floor", PlaneField(Vec3d(0, -1, 0), kUp), 0.5, 0.3}});
    StepOptions options;
    options.dt = 2e-3;
    for (int i = 0; i < 200; ++i) {
        const Vec3d start = random.in(Box{Vec3d(-1, 0.9, -1), Vec3d(1, 2, 1)});
        MovingParticle lazy = placed(start, Vec3d::Zero(), colliders, 0.02);
        MovingParticle eager = lazy;
        StepTally tally(2);
        for (int s = 0; s < 600; ++s) {
            step(lazy, colliders, options, tally);
            eager.clearance = 0.0;
            step(eager, colliders, options, tally);
            REQUIRE(lazy.position == eager.position);
            REQUIRE(lazy.velocity == eager.velocity);
        }
    }
}

TEST_CASE("a pass has the same bits for any number of threads and any split into passes")
{
    VDBOUNCE_RANDOM(random);
    const StillColliders colliders(
        {{"ball", std::make_shared<const DistanceField>(levelSet(bandGrid(sphere(0.8), uniformTransform(0.05), 22))),
          0.5, 0.3},
         {"floor", PlaneField(Vec3d(0, -1, 0), kUp), 0.5, 0.3}});
    Particles start;
    start.resize(20000);
    for (Vec3d& p : start.position) p = random.in(Box{Vec3d(-1, 0.9, -1), Vec3d(1, 2, 1)});
    start.ensureVelocity();
    start.position[77].x() = std::nan("");
    const StepOptions options;
    const ParticleDefaults defaults{0.01, 2.0};

    Particles whole = start;
    const PassReport all = advanceParticles(whole, colliders, options, defaults, 120);
    CHECK(all.rejected == 1);
    CHECK(std::isnan(whole.position[77].x()));
    for (std::size_t threads : {1u, 3u}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        Particles same = start;
        const PassReport report = advanceParticles(same, colliders, options, defaults, 120);
        same.position[77] = whole.position[77] = Vec3d::Zero();
        CHECK(same.position == whole.position);
        CHECK(same.velocity == whole.velocity);
        CHECK(report.tally.impulse == all.tally.impulse);
        CHECK(report.tally.angularImpulse == all.tally.angularImpulse);
        CHECK(totalEnergy(same, defaults, options.gravity) == totalEnergy(whole, defaults, options.gravity));
    }
    Particles parts = start;
    for (int i = 0; i < 12; ++i) advanceParticles(parts, colliders, options, defaults, 10);
    parts.position[77] = Vec3d::Zero();
    CHECK(parts.position == whole.position);
    CHECK(parts.velocity == whole.velocity);
}

TEST_CASE("a fast particle that starts slightly inside a plate does not pass through it")
{
    const Phi plate = [](const Vec3d& p) { return std::abs(p.y()) - 0.1; };
    const StillColliders colliders(
        {{"plate", std::make_shared<const DistanceField>(levelSet(bandGrid(plate, uniformTransform(0.05), 20))), 0.5,
          0.2}});
    StepOptions options;
    for (double speed : {1.0, 10.0, 100.0, 1e4}) {
        MovingParticle particle = placed(Vec3d(0, 0.0999, 0), Vec3d(0, -speed, 0), colliders);
        REQUIRE(particle.inside);
        StepTally tally(1);
        for (int s = 0; s < 50; ++s) step(particle, colliders, options, tally);
        CHECK(particle.position.y() > 0.09);
    }
}

TEST_CASE("angular impulse is that of the point of contact, also for fast particles")
{
    const Phi plate = [](const Vec3d& p) { return std::abs(p.y()) - 0.1; };
    const StillColliders colliders(
        {{"plate", std::make_shared<const DistanceField>(levelSet(bandGrid(plate, uniformTransform(0.05), 60))), 0.3,
          0.0}});
    StepOptions options;
    options.gravity = Vec3d::Zero();
    StepTally tally(1);
    MovingParticle straight = placed(Vec3d(0.5, 1, 0), Vec3d(0, -1000, 0), colliders);
    MovingParticle oblique = placed(Vec3d(0.5, 1, 0), Vec3d(1000, -1000, 0), colliders);
    step(straight, colliders, options, tally);
    step(oblique, colliders, options, tally);
    CHECK(tally.impulse[0].y() == Approx(-2600));
    CHECK(tally.angularImpulse[0].z() == Approx(-1300 * 0.5 - 1300 * 1.4).epsilon(0.002));
}

TEST_CASE("speeds without any sense end the step and not the run")
{
    std::vector<Collider> list = {
        {"ball", std::make_shared<const DistanceField>(levelSet(bandGrid(sphere(0.8), uniformTransform(0.05), 22))),
         0.5, 0.3}};
    list.push_back({"floor", PlaneField(Vec3d::Zero(), kUp), 0.5, 0.3});
    const StillColliders colliders(std::move(list));
    StepOptions options;
    options.gravity = Vec3d::Zero();
    for (double speed : {1e8, 1e17, 1e100, 1e200, 1e308}) {
        MovingParticle particle = placed(Vec3d(5, 1e-4, 0), Vec3d(speed, 0, speed), colliders);
        StepTally tally(2);
        for (int s = 0; s < 3; ++s) step(particle, colliders, options, tally);
        CHECK(particle.position.allFinite());
    }
}

TEST_CASE("an empty level set is nowhere")
{
    auto grid = openvdb::FloatGrid::create(0.3f);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    const StillColliders colliders({{"nothing", std::make_shared<const DistanceField>(levelSet(grid)), 0.5, 0.3}});
    StepOptions options;
    MovingParticle particle = placed(Vec3d(0, 5, 0), Vec3d::Zero(), colliders, 0.5);
    StepTally tally(1);
    for (int s = 0; s < 100; ++s) step(particle, colliders, options, tally);
    CHECK(tally.unresolved == 0);
    CHECK(particle.position.y() < 5.0);
}

TEST_CASE("a jump between tiles is not missed by the clearance")
{
    auto grid = openvdb::FloatGrid::create(0.3f);
    grid->setTransform(uniformTransform(0.1));
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    grid->fill(openvdb::CoordBBox(openvdb::Coord(-32), openvdb::Coord(31)), 0.3f, true);
    grid->fill(openvdb::CoordBBox(openvdb::Coord(-16), openvdb::Coord(15)), -0.3f, true);
    grid->tree().prune();
    const StillColliders colliders({{"block", std::make_shared<const DistanceField>(levelSet(grid)), 0.5, 0.3}});
    StepOptions options;
    MovingParticle particle = placed(Vec3d(0, 1.61, 0), Vec3d(0, -20, 0), colliders);
    REQUIRE_FALSE(particle.inside);
    StepTally tally(1);
    for (int s = 0; s < 20; ++s) {
        step(particle, colliders, options, tally);
        REQUIRE(colliders.probe(particle.position, 0.0).gap >= 0.0);
    }
}
