// SPDX-License-Identifier: Apache-2.0
#include "support/fields.h"
#include "support/random.h"
#include "support/step_options.h"

#include "vdbounce/contact/body_mass.h"
#include "vdbounce/contact/particle_pass.h"

#include <catch2/catch.hpp>

#include <tbb/global_control.h>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

Collider lightBall(double mass)
{
    Collider ball{"ball", fieldOf(sphere(0.5), 0.05, 16, 4.0), 0.3, 0.4};
    BodyMass body;
    body.mass = mass;
    body.inertia = 0.1 * mass * Mat3d::Identity();
    ball.body = body;
    return ball;
}

double kinetic(const Particles& particles, const ParticlePass& pass)
{
    double energy = totalEnergy(particles, {0.0, 1.0}, Vec3d::Zero());
    for (const auto& body : pass.bodies()) {
        if (body) energy += body->energy(Vec3d::Zero());
    }
    return energy;
}

Vec3d momentum(const Particles& particles, const ParticlePass& pass)
{
    Vec3d sum = Vec3d::Zero();
    for (std::size_t i = 0; i < particles.size(); ++i) sum += particles.mass[i] * particles.velocity[i];
    for (const auto& body : pass.bodies()) {
        if (body) sum += body->momentum();
    }
    return sum;
}

// A free sphere in a hail of particles, without gravity.
struct Hail {
    Particles particles;
    double largestMomentumError = 0.0; // relative to the sum of all momenta's lengths
    double largestGain = 0.0;          // of energy in a step, relative
    std::uint64_t contacts = 0;
    std::vector<double> bodyState;
};

Hail hailOn(const ColliderSet& colliders, const Particles& start, Scheme scheme, double dt)
{
    Hail run;
    run.particles = start;
    PassOptions options;
    options.step = weightless(dt);
    options.step.scheme = scheme;
    options.defaults = {0.01, 0.02};
    ParticlePass pass(run.particles, colliders, options);
    const auto momentum = [&] {
        Vec3d sum = pass.bodies()[0]->momentum();
        for (const Vec3d& v : run.particles.velocity) sum += options.defaults.mass * v;
        return sum;
    };
    const auto energyNow = [&] {
        return pass.bodies()[0]->energy(Vec3d::Zero()) +
               totalEnergy(run.particles, options.defaults, options.step.gravity);
    };
    double scale = pass.bodies()[0]->momentum().norm();
    for (const Vec3d& v : run.particles.velocity) scale += options.defaults.mass * v.norm();
    const Vec3d whole = momentum();
    double before = energyNow();
    for (int s = 0; s < 300; ++s) {
        run.contacts += pass.advance(1).tally.contacts;
        run.largestMomentumError = std::max(run.largestMomentumError, (momentum() - whole).norm() / scale);
        const double now = energyNow();
        run.largestGain = std::max(run.largestGain, (now - before) / before);
        before = now;
    }
    const RigidVelocity velocity = pass.bodies()[0]->velocity();
    for (const Vec3d& v : {velocity.linear, velocity.angular, velocity.centre})
        run.bodyState.insert(run.bodyState.end(), {v.x(), v.y(), v.z()});
    return run;
}

} // namespace

TEST_CASE("heavy particles do not throw a light ball about, in any scheme")
{
    VDBOUNCE_RANDOM(random);
    for (Scheme scheme : {Scheme::CollideContact, Scheme::Iterate, Scheme::Once}) {
        for (int i = 0; i < 200; ++i) {
            const ColliderSet colliders(
                {lightBall(0.1),
                 {"floor", PlaneField(Vec3d(0, -0.5, 0), Vec3d(random.uniform(-1, 1), 1, 0)), 0.3, 0.0}});
            Particles particles;
            particles.resize(1);
            particles.mass = {1000.0};
            particles.radius = {0.05};
            do particles.position[0] = random.in(Box{Vec3d::Constant(-0.8), Vec3d::Constant(0.8)});
            while (PlacedColliders(colliders).probe(particles.position[0], 0.05).gap < 0.0);
            particles.velocity = {random.direction()};
            PassOptions options;
            options.step.scheme = scheme;
            options.step.gravity = Vec3d::Zero();
            options.step.maxBounces = i % 2 == 0 ? 3 : 0;
            options.step.dt = 0.02;
            ParticlePass pass(particles, colliders, options);
            const double before = kinetic(particles, pass);
            for (int s = 0; s < 40; ++s) {
                pass.advance(1);
                INFO("scheme " << int(scheme) << ", case " << i << ", step " << s << ", ball "
                               << pass.bodies()[0]->velocity().linear.transpose());
                REQUIRE(kinetic(particles, pass) <= before * (1.0 + 1e-9));
            }
        }
    }
}

TEST_CASE("a heap of heavy particles on a light board gains nothing from it")
{
    const ColliderSet colliders({lightBall(1.0)});
    Particles particles;
    particles.resize(10);
    particles.mass.assign(10, 100.0);
    particles.radius.assign(10, 0.05);
    particles.velocity.assign(10, Vec3d(0, -1, 0));
    for (int i = 0; i < 10; ++i) particles.position[std::size_t(i)] = Vec3d(0, 0.551 + 0.1 * i, 0);
    PassOptions options;
    options.interact = true;
    options.particles.restitution = 0.0;
    options.step.gravity = Vec3d::Zero();
    options.step.dt = 0.01;
    ParticlePass pass(particles, colliders, options);
    const double before = kinetic(particles, pass);
    const Vec3d together = momentum(particles, pass);
    for (int s = 0; s < 100; ++s) {
        pass.advance(1);
        INFO("step " << s);
        REQUIRE(kinetic(particles, pass) <= before * (1.0 + 1e-9));
        REQUIRE((momentum(particles, pass) - together).norm() <= 1e-12 * together.norm());
    }
    CHECK(pass.bodies()[0]->velocity().linear.y() < -0.5);
}

TEST_CASE("a free body falls as a particle does")
{
    const ColliderSet colliders({lightBall(3.0)});
    Particles particles;
    particles.resize(1);
    particles.position = {Vec3d(5, 0, 0)};
    PassOptions options;
    options.step.dt = 0.004;
    ParticlePass pass(particles, colliders, options);
    pass.advance(500);
    const RigidVelocity body = pass.bodies()[0]->velocity();
    CHECK(body.centre.y() == Approx(particles.position[0].y()));
    CHECK(body.linear.y() == Approx(particles.velocity[0].y()));
}

TEST_CASE("particles and a free body keep their momentum, gain no energy, and do so on any number of threads")
{
    VDBOUNCE_RANDOM(random);
    const Shape ball = fieldOf(sphere(0.5), 0.05, 14);
    Particles start;
    start.resize(1000);
    start.ensureVelocity();
    for (std::size_t i = 0; i < start.size(); ++i) {
        start.position[i] = random.uniform(0.6, 2.0) * random.direction();
        start.velocity[i] = random.uniform(0.5, 4.0) * (0.4 * random.direction() - start.position[i]).normalized();
    }
    for (Scheme scheme : {Scheme::CollideContact, Scheme::Iterate}) {
        for (double e : {0.0, 0.5, 1.0}) {
            for (double mu : {0.0, 0.4}) {
                INFO("scheme " << int(scheme) << ", restitution " << e << ", mu " << mu);
                Collider thing{"ball", ball, e, mu};
                thing.body = evenDensity(ball, 1.0);
                REQUIRE(thing.body);
                thing.body->velocity = Vec3d(0.3, 0, 0.1);
                thing.body->angularVelocity = Vec3d(0, 2, 1);
                const ColliderSet colliders({thing});
                const Hail run = hailOn(colliders, start, scheme, 2e-3);
                CHECK(run.contacts > 500);
                CHECK(run.largestMomentumError <= 1e-12);
                CHECK(run.largestGain <= 1e-9);
                if (scheme != Scheme::CollideContact || e != 0.5) continue;
                for (std::size_t threads : {1u, 2u, 3u}) {
                    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
                    const Hail same = hailOn(colliders, start, scheme, 2e-3);
                    CHECK(same.particles.position == run.particles.position);
                    CHECK(same.particles.velocity == run.particles.velocity);
                    CHECK(same.bodyState == run.bodyState);
                }
            }
        }
    }
}

TEST_CASE("a particle and a free sphere that meet head-on part as in one dimension")
{
    const Shape ball = fieldOf(sphere(0.5), 0.05, 14);
    for (double mass : {0.1, 1.0, 20.0}) {
        for (double e : {0.3, 1.0}) {
            INFO("mass " << mass << ", restitution " << e);
            Collider thing{"ball", ball, e, 0.2};
            thing.body = evenDensity(ball, 1.0);
            const ColliderSet colliders({thing});
            Particles particles;
            particles.resize(1);
            particles.position[0] = Vec3d(-1, 0, 0);
            particles.ensureVelocity();
            particles.velocity[0] = Vec3d(3, 0, 0);
            PassOptions options;
            options.step = weightless(1e-3);
            options.defaults = {0.02, mass};
            ParticlePass pass(particles, colliders, options);
            pass.advance(400);
            const double together = mass * 3.0 / (mass + 1.0);
            CHECK(particles.velocity[0].x() == Approx(together - e * 3.0 / (mass + 1.0)).margin(0.03));
            CHECK(pass.bodies()[0]->velocity().linear.x() ==
                  Approx(together + e * 3.0 * mass / (mass + 1.0)).margin(0.03));
        }
    }
}
