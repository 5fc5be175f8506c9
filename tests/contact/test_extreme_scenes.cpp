// SPDX-License-Identifier: Apache-2.0
#include "support/fields.h"
#include "support/grounds.h"
#include "support/one_particle.h"
#include "support/stability_table.h"

#include <catch2/catch.hpp>

#include <cmath>

/// @file
/// How large and how far away scenes can be, and how long steps. Each test writes what it measured by stabilityRow().

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

constexpr double kVoxel = 0.05;

// The same scene in other units: a bounce, a slide and a rest on tilted ground, in voxels and seconds of the original.
struct Outcome {
    Vec3d bounced;
    Vec3d bounceVelocity;
    Vec3d slid;
    Vec3d rested;
    double drift = 0.0; // of what rests

    double differs(const Outcome& other) const
    {
        return std::max({(bounced - other.bounced).norm(), (bounceVelocity - other.bounceVelocity).norm() / 100.0,
                         (slid - other.slid).norm(), (rested - other.rested).norm()});
    }
};

// `voxel` is the length of a voxel, `second` that of a second, `origin` where the scene is.
Outcome play(double voxel, double second, const Vec3d& origin)
{
    const Vec3d normal(0.02, 1, 0.01);
    const Phi phi = [=](const Vec3d& p) { return normal.normalized().dot(p - origin) - 0.22 * voxel; };
    const StillColliders colliders(
        {{"ground", fieldOf(phi, affineTransform(voxel * Mat3d::Identity(), origin), 30, 6.0), 0.6, 0.3}});
    StepOptions options;
    options.dt = 1e-3 * second;
    options.gravity = Vec3d(0, -200 * voxel / (second * second), 0);
    const auto run = [&](const Vec3d& from, const Vec3d& velocity, int steps) {
        MovingParticle particle = placed(origin + voxel * from, voxel / second * velocity, colliders, 0.4 * voxel);
        StepTally tally(1);
        for (int s = 0; s < steps; ++s) step(particle, colliders, options, tally);
        return particle;
    };
    const auto inVoxels = [&](const MovingParticle& particle) { return Vec3d((particle.position - origin) / voxel); };
    Outcome outcome;
    const MovingParticle bounced = run(Vec3d(-2, 12, 1), Vec3d(4, 0, -3), 1000);
    outcome.bounced = inVoxels(bounced);
    outcome.bounceVelocity = bounced.velocity * second / voxel;
    outcome.slid = inVoxels(run(Vec3d(-10, 0.9, 0), Vec3d(40, 0, 5), 2500));
    MovingParticle rests = run(Vec3d(3, 5, 2), Vec3d::Zero(), 4000);
    outcome.rested = inVoxels(rests);
    StepTally tally(1);
    for (int s = 0; s < 2000; ++s) step(rests, colliders, options, tally);
    outcome.drift = (inVoxels(rests) - outcome.rested).norm();
    return outcome;
}

} // namespace

TEST_CASE("a scene of any size gives the same answers", "[extremes]")
{
    const Outcome expected = play(kVoxel, 1.0, Vec3d::Zero());
    double worst = 0.0;
    double drift = expected.drift;
    for (double voxel : {1.6e-5, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6}) {
        // With gravity in proportion, and with the gravity of the first, where time goes with the root of the size.
        for (double second : {1.0, std::sqrt(voxel / kVoxel)}) {
            INFO("voxel " << voxel << ", second " << second);
            const Outcome same = play(voxel, second, Vec3d::Zero());
            worst = std::max(worst, same.differs(expected));
            drift = std::max(drift, same.drift);
            CHECK(same.differs(expected) <= 1e-4);
            CHECK(same.drift == 0.0);
        }
    }
    stabilityRow("voxel side", "1.6e-5 to 1e6 world units", "largest difference of places, voxels", worst);
    stabilityRow("at rest in scenes of these sizes", "1.6e-5 to 1e6 world units", "drift, voxels", drift);
}

TEST_CASE("a scene a million times its size from the origin gives the same answers", "[extremes]")
{
    const Outcome expected = play(kVoxel, 1.0, Vec3d::Zero());
    double worst = 0.0;
    double drift = 0.0;
    const double size = 60 * kVoxel;
    for (double away : {1e2, 1e4, 1e6}) {
        for (const Vec3d& towards : {Vec3d(1, 0, 0), Vec3d(-0.3, 0.9, 0.7)}) {
            INFO(away << " sizes towards " << towards.transpose());
            const Outcome same = play(kVoxel, 1.0, away * size * towards);
            worst = std::max(worst, same.differs(expected));
            drift = std::max(drift, same.drift);
            CHECK(same.differs(expected) <= 1e-4);
            CHECK(same.drift == 0.0);
        }
    }
    stabilityRow("distance from the origin", "up to 1e6 times the scene's size", "largest difference of places, voxels",
                 worst);
    stabilityRow("at rest there", "up to 1e6 times the scene's size", "drift, voxels", drift);
}

TEST_CASE("steps from a nanosecond to ten seconds", "[extremes]")
{
    const double e = 0.6;
    const double mu = 0.3;
    double worstBounce = 0.0;
    double worstSlide = 0.0;
    double worstGain = 0.0;
    for (const Ground& ground : grounds(kUp)) {
        const StillColliders colliders = single(ground, e, mu);
        for (double dt : {1e-9, 1e-7, 1e-5, 1e-3, 1e-1, 1.0, 10.0}) {
            INFO(ground.name << ", dt " << dt);
            StepOptions options;
            options.dt = dt;
            StepTally tally(1);
            MovingParticle falls =
                placed(Vec3d(0.1, kGroundOffset + 0.02 + 10.5 * dt, 0), Vec3d(0, -1, 0), colliders, 0.02);
            double before = energy(falls, options.gravity);
            for (int s = 0; s < 100; ++s) {
                step(falls, colliders, options, tally);
                REQUIRE(colliders.probe(falls.position, falls.radius).gap >= 0.0);
                const double now = energy(falls, options.gravity);
                worstGain = std::max(worstGain, (now - before) / (1.0 + std::abs(before)));
                REQUIRE(now <= before + 1e-12 * (1.0 + std::abs(before)));
                before = now;
            }
            // Later it has come down again.
            if (dt <= 1e-5) {
                const double expected = e * (1.0 + 10.5 * kGravity * dt) - 89.5 * kGravity * dt;
                CHECK(falls.velocity.y() == Approx(expected).margin(2.0 * kGravity * dt));
                worstBounce = std::max(worstBounce, std::abs(falls.velocity.y() - expected));
            }
            MovingParticle slides = placed(Vec3d(0.1, kGroundOffset, 0), Vec3d(1, 0, 0), colliders);
            for (int s = 0; s < 100; ++s) step(slides, colliders, options, tally);
            if (dt <= 1e-3) {
                const double expected = 1.0 - 100 * dt * mu * kGravity;
                CHECK(slides.velocity.x() == Approx(expected).epsilon(1e-3));
                worstSlide = std::max(worstSlide, std::abs(slides.velocity.x() / expected - 1.0));
            } else {
                CHECK(slides.velocity.norm() == 0.0);
            }
            // Once it rests nothing moves it.
            MovingParticle rests = placed(Vec3d(0.1, kGroundOffset, 0.2), Vec3d::Zero(), colliders);
            for (int s = 0; s < 100; ++s) step(rests, colliders, options, tally);
            const Vec3d at = rests.position;
            for (int s = 0; s < 1000; ++s) step(rests, colliders, options, tally);
            CHECK((rests.position - at).norm() <= 1e-6 * kGroundVoxel);
        }
    }
    stabilityRow("dt", "1e-9 to 10 s", "most energy gained in a step, relative", worstGain);
    stabilityRow("bounce", "dt 1e-9 to 1e-5 s", "error of the speed after, of 0.6", worstBounce);
    stabilityRow("sliding", "dt 1e-9 to 1e-3 s", "relative error of the speed after 100 steps", worstSlide);
}
