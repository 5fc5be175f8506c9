// SPDX-License-Identifier: Apache-2.0
#include "support/fields.h"
#include "support/grounds.h"
#include "support/moving_scene.h"
#include "support/random.h"
#include "support/step_options.h"

#include "vdbounce/contact/particle_pass.h"

#include <catch2/catch.hpp>

#include <cmath>

/// @file
/// What becomes of a particle that hits: it sticks, is deleted, or keeps a record of the hit.

using namespace vdbounce;
using namespace vdbounce::test;

TEST_CASE("what sticks stays at one point of its collider")
{
    VDBOUNCE_RANDOM(random);
    const auto ball = fieldOf(sphere(0.5, Vec3d(0.3, 0, 0)), 0.05, 20);
    for (int i = 0; i < 20; ++i) {
        const Motion motion = moving(random.direction(), 4.0 * random.direction(), 0.2 * random.direction());
        MovingScene scene({collider(ball, 0.3, 0.5, motion, OnHit::Stick)}, millisecond());
        const Vec3d from = 1.2 * random.direction();
        MovingParticle particle = scene.particle(from, -8.0 * from, 0.02);
        while (particle.stuckTo == MovingParticle::kNotStuck && scene.time() < 1.0) scene.advance(particle);
        REQUIRE(particle.stuckTo == 0);
        CHECK(std::abs(scene.gap(particle)) <= 1e-2 * 0.05);
        const Vec3d held = scene.placement().end.toLocal(particle.position);
        for (int s = 0; s < 1000; ++s) scene.advance(particle);
        CHECK((scene.placement().end.toLocal(particle.position) - held).norm() < 1e-9);
        CHECK((particle.velocity - motion.velocityAt(scene.time()).at(particle.position)).norm() < 1e-9);
    }
}

TEST_CASE("what touches a collider that deletes is removed and counted")
{
    Particles particles;
    particles.resize(200);
    for (std::size_t i = 0; i < 200; ++i) particles.position[i] = Vec3d(0.001 * double(i), i % 2 == 0 ? 0.5 : 5.0, 0.0);
    const ColliderSet colliders({collider(grounds(kUp)[1].shape, 0.3, 0.5, Motion(), OnHit::Delete)});
    ParticlePass pass(particles, colliders, PassOptions());
    CHECK(pass.advance(20).deleted == 0);
    CHECK(pass.advance(100).deleted == 100);
    REQUIRE(particles.size() == 100);
    for (std::size_t i = 0; i < 100; ++i) CHECK(particles.id[i] == std::int64_t(2 * i + 1));
    CHECK(pass.advance(20).deleted == 0);
}

TEST_CASE("a drop's hit tells time, place, normal, velocity and collider")
{
    const double radius = 0.02;
    const auto list = grounds(kUp);
    for (std::size_t g = 0; g < 3; ++g) {
        INFO(list[g].name);
        const ColliderSet colliders({collider(fieldOf(sphere(0.2, Vec3d(0, 0, 1)), 0.05, 28), 0.3, 0.5, Motion()),
                                     collider(list[g].shape, 0.4, 0.5, Motion())});
        Particles particles;
        particles.resize(1);
        particles.position[0] = Vec3d(0.1, kGroundOffset + radius + 1.0, -0.5);
        particles.ensureVelocity();
        particles.velocity[0] = Vec3d(0.2, 0, 0);
        PassOptions options;
        options.step = millisecond();
        options.defaults.radius = radius;
        options.hits = true;
        ParticlePass pass(particles, colliders, options);
        const double falls = std::sqrt(2.0 / kGravity);
        pass.advance(int(falls / options.step.dt) - 1);
        CHECK(particles.hits[0].count == 0);
        CHECK(particles.hits[0].collider == -1);
        pass.advance(3);
        const HitRecord& hit = particles.hits[0];
        CHECK(hit.count == 1);
        CHECK(hit.collider == 1);
        CHECK(hit.time == Approx(falls).margin(options.step.dt));
        CHECK((hit.position - Vec3d(0.1 + 0.2 * falls, kGroundOffset, -0.5)).norm() <= 6.0 * options.step.dt);
        CHECK((hit.normal - kUp).norm() <= 1e-5);
        CHECK((hit.velocity - Vec3d(0.2, -kGravity * falls, 0)).norm() <= 2.0 * kGravity * options.step.dt);
        // At rest it touches all the time, and that is one hit.
        pass.advance(4000);
        const int count = hit.count;
        CHECK(count > 3);
        pass.advance(2000);
        CHECK(hit.count == count);
    }
}

TEST_CASE("a hit's time does not depend on how many steps a call takes")
{
    Collider sticky = collider(PlaneField(Vec3d::Zero(), kUp), 0.0, 0.5, Motion());
    sticky.onHit = OnHit::Stick;
    const ColliderSet still({sticky});
    std::vector<double> times;
    for (const int stepsAtOnce : {1, 7, 700}) {
        Particles particles;
        particles.resize(1);
        particles.position[0] = Vec3d(0, 1, 0);
        PassOptions options;
        options.step = millisecond();
        options.hits = true;
        ParticlePass pass(particles, still, options);
        for (int s = 0; s < 700; s += stepsAtOnce) pass.advance(stepsAtOnce);
        times.push_back(particles.hits[0].time);
    }
    CHECK(times[0] == Approx(std::sqrt(2.0 / kGravity)).margin(1e-3));
    CHECK(times[1] == times[0]);
    CHECK(times[2] == times[0]);
}
