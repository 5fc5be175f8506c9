// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/random.h"
#include "support/still_colliders.h"

#include "vdbounce/contact/step.h"

#include <cmath>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

StillColliders floorWith(double friction)
{
    const auto field = std::make_shared<const DistanceField>(
        levelSet(bandGrid(halfSpace(Vec3d(0, 1, 0), 0.011), uniformTransform(0.05), 40, 8.0)));
    return StillColliders({{"floor", field, 0.5, friction}});
}

MovingParticle at(const Vec3d& position, const Vec3d& velocity, const PlacedColliders& colliders)
{
    MovingParticle particle;
    particle.position = position;
    particle.velocity = velocity;
    settle(particle, colliders);
    return particle;
}

} // namespace

TEST_CASE("repulsion turns a particle back within its range and gives its speed back")
{
    const StillColliders colliders = floorWith(0.0);
    StepOptions options;
    options.dt = 1e-4;
    options.gravity = Vec3d::Zero();
    options.repulsion = {0.2, 100.0};
    MovingParticle particle = at(Vec3d(0, 0.5, 0), Vec3d(0.5, -2, 0), colliders);
    StepTally tally(1);
    double nearest = 1.0;
    for (int s = 0; s < 5000; ++s) {
        step(particle, colliders, options, tally);
        nearest = std::min(nearest, particle.position.y() - 0.011);
    }
    CHECK(tally.contacts == 0);
    // It goes in until the force's work, strength / range (range - gap)^2 / 2, is its kinetic energy.
    CHECK(nearest == Approx(0.2 - std::sqrt(4.0 * 0.2 / 100.0)).epsilon(0.01));
    CHECK(particle.velocity.y() == Approx(2.0).epsilon(0.01));
    CHECK(particle.velocity.x() == Approx(0.5));
    CHECK(tally.impulse[0].y() == Approx(-4.0).epsilon(0.01));
}

TEST_CASE("a particle rests where repulsion carries its weight, and friction stops it there")
{
    const StillColliders colliders = floorWith(0.4);
    StepOptions options;
    options.dt = 1e-3;
    options.repulsion = {0.2, 4.0 * 9.81};
    MovingParticle particle = at(Vec3d(-0.5, 0.161, 0), Vec3d(0.8, 0, 0), colliders);
    StepTally tally(1);
    for (int s = 0; s < 20000; ++s) step(particle, colliders, options, tally);
    // A quarter of the range in: a quarter of the strength. It goes on swinging around it, for nothing damps it.
    CHECK(particle.position.y() - 0.011 == Approx(0.15).margin(0.005));
    CHECK(std::abs(particle.velocity.x()) < 1e-9);
    CHECK(particle.position.x() == Approx(-0.5 + 0.64 / (2.0 * 0.4 * 9.81)).epsilon(0.02));
}

TEST_CASE("with scheme once, what penetrates at both ends gets an impulse in proportion to its depth, with friction")
{
    const StillColliders colliders = floorWith(0.3);
    StepOptions options;
    options.scheme = Scheme::Once;
    options.gravity = Vec3d::Zero();
    options.dt = 0.01;
    for (double depth : {0.01, 0.02, 0.04}) {
        MovingParticle particle = at(Vec3d(0, 0.011 - depth, 0), Vec3d(3, 0, 0), colliders);
        REQUIRE(particle.inside);
        StepTally tally(1);
        step(particle, colliders, options, tally);
        const double impulse = 0.2 * depth / options.dt;
        CHECK(particle.velocity.y() == Approx(impulse).epsilon(1e-6));
        CHECK(particle.velocity.x() == Approx(3.0 - 0.3 * impulse).epsilon(1e-6));
        for (int s = 0; s < 20; ++s) step(particle, colliders, options, tally);
        CHECK_FALSE(particle.inside);
    }
}

TEST_CASE("a normal never points in, wherever a trilinear field has one")
{
    VDBOUNCE_RANDOM(random);
    // Creases, plates about a voxel thick and the medial axis of thin ones: where central differences reach across.
    const Phi shapes[] = {
        [](const Vec3d& p) { return std::abs(p.y() - 0.013) - 0.03; },
        [](const Vec3d& p) { return std::max(std::abs(p.x()), std::abs(p.y())) - 0.04; },
        [](const Vec3d& p) { return std::min((p - Vec3d(0.06, 0, 0)).norm(), (p + Vec3d(0.06, 0, 0)).norm()) - 0.055; },
        [](const Vec3d& p) { return std::max(0.03 - p.cwiseAbs().minCoeff(), p.norm() - 0.5); },
    };
    for (const Phi& phi : shapes) {
        const auto field =
            std::make_shared<const DistanceField>(levelSet(bandGrid(phi, uniformTransform(0.05), 16, 4.0)));
        const StillColliders colliders({{"shape", field, 0.5, 0.3}});
        const PlacedColliders& placed = colliders;
        int normals = 0;
        for (int i = 0; i < 20000; ++i) {
            const Vec3d p = random.in(Box{Vec3d::Constant(-0.3), Vec3d::Constant(0.3)});
            Vec3d normal;
            if (!placed.normalAt(0, p, normal)) continue;
            ++normals;
            REQUIRE(normal.norm() == Approx(1.0));
            REQUIRE(field->phi(p + 1e-7 * normal) >= field->phi(p) - 1e-12);
        }
        CHECK(normals > 10000);
    }
}
