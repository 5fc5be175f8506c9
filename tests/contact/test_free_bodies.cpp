// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/random.h"

#include "vdbounce/contact/particle_pass.h"

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

Collider lightBall(double mass)
{
    Collider ball{
        "ball", std::make_shared<const DistanceField>(levelSet(bandGrid(sphere(0.5), uniformTransform(0.05), 16, 4.0))),
        0.3, 0.4};
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
