// SPDX-License-Identifier: Apache-2.0
#include "support/fields.h"
#include "support/grounds.h"
#include "support/one_particle.h"
#include "support/random.h"
#include "support/stability_table.h"
#include "support/step_options.h"

#include "vdbounce/contact/body_mass.h"
#include "vdbounce/contact/particle_pass.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <sstream>

/// @file
/// How fast, large and heavy particles can be, how elastic and rough colliders, and how thin. Each test writes what it
/// measured by stabilityRow().

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

constexpr double kVoxel = 0.05;

Phi plate(double thicknessVx)
{
    return [=](const Vec3d& p) {
        const Vec3d d =
            Vec3d(std::abs(p.x()), std::abs(p.y() - 0.013), std::abs(p.z())) - Vec3d(1, 0.5 * thicknessVx * kVoxel, 1);
        return d.cwiseMax(0.0).norm() + std::min(0.0, d.maxCoeff());
    };
}

// Whether a straight way leads through the plate and not around it.
bool passesPlate(const Vec3d& from, const Vec3d& to)
{
    if ((from.y() - 0.013) * (to.y() - 0.013) >= 0.0) return false;
    const Vec3d crossing = from + (0.013 - from.y()) / (to.y() - from.y()) * (to - from);
    return std::max(std::abs(crossing.x()), std::abs(crossing.z())) < 1.0 - 1.5 * kVoxel;
}

// How many of random shots from outside, 10^low to 10^high voxels a step fast, end inside or `passes` tells of.
int leaksOf(const FieldPtr& field, int shots, double low, double high,
            const std::function<bool(const Vec3d&, const Vec3d&)>& passes)
{
    Random random;
    StepOptions options;
    options.dt = 0.01;
    options.gravity = Vec3d::Zero();
    int leaks = 0;
    for (int i = 0; i < shots; ++i) {
        const StillColliders colliders({{"target", field, random.uniform(0, 1), random.uniform(0, 1)}});
        const Vec3d from(random.uniform(-0.8, 0.8), random.uniform(1.1, 3), random.uniform(-0.8, 0.8));
        const Vec3d aim(random.uniform(-0.8, 0.8), 0.013, random.uniform(-0.8, 0.8));
        const double speed = kVoxel / options.dt * std::pow(10.0, random.uniform(low, high));
        MovingParticle particle =
            placed(from, speed * (aim - from).normalized(), colliders, i % 2 == 0 ? 0.0 : random.uniform(0, kVoxel));
        StepTally tally(1);
        for (int s = 0; s < 30; ++s) {
            const Vec3d before = particle.position;
            step(particle, colliders, options, tally);
            const bool inside = !(colliders.probe(particle.position, particle.radius).gap >= 0.0);
            if (!inside && !passes(before, particle.position)) continue;
            ++leaks;
            break;
        }
    }
    return leaks;
}

bool never(const Vec3d&, const Vec3d&) { return false; }

} // namespace

TEST_CASE("speeds up to a thousand million voxels a step do not leak", "[extremes]")
{
    const int leaks = leaksOf(fieldOf(plate(2.0), uniformTransform(kVoxel), 26), 3000, 5, 9, passesPlate) +
                      leaksOf(fieldOf(sphere(0.9), uniformTransform(kVoxel), 22), 3000, 5, 9, never);
    CHECK(leaks == 0);
    stabilityRow("speed", "1e5 to 1e9 voxels a step", "leaks of 3000 shots each at a plate of 2 voxels and a sphere",
                 leaks);
}

TEST_CASE("radii from nothing to 50 voxels", "[extremes]")
{
    const double voxel = 0.02;
    const double e = 0.8;
    // A radius wide, bands know their distance where a particle's centre is.
    const FieldPtr floor = fieldOf(halfSpace(kUp, 0.22 * voxel), uniformTransform(voxel), 58, 55.0);
    const FieldPtr ball = fieldOf(sphere(10 * voxel), uniformTransform(voxel), 68, 56.0);
    const double tops[] = {0.22 * voxel, 10 * voxel};
    double worst = 0.0;
    for (double radius : {0.0, 1e-6, 1e-3, 0.5, 1.0, 5.0, 20.0, 50.0}) {
        for (int shape : {0, 1}) {
            INFO("radius " << radius << " voxels on " << (shape == 0 ? "a floor" : "a ball"));
            const StillColliders colliders({{"thing", shape == 0 ? floor : ball, e, 0.3}});
            const double r = radius * voxel;
            const double height = 2.0;
            MovingParticle particle = placed(Vec3d(0, tops[shape] + r + height, 0), Vec3d::Zero(), colliders, r);
            StepTally tally(1);
            while (particle.velocity.y() <= 0.0 && tally.near < 2000) step(particle, colliders, millisecond(), tally);
            const double peak =
                particle.position.y() - r - tops[shape] + particle.velocity.squaredNorm() / (2 * kGravity);
            worst = std::max(worst, std::abs(peak - e * e * height) / height);
            // Trilinear lookup takes h^2 / (8 R) off a sphere of radius R, and its top tilts by less than that.
            CHECK(peak == Approx(e * e * height).epsilon(0.005));
            MovingParticle beside = placed(Vec3d(0.11, tops[shape] + r + 0.3, 0.05), Vec3d(0.3, 0, 0), colliders, r);
            for (int s = 0; s < 1500; ++s) {
                step(beside, colliders, millisecond(), tally);
                REQUIRE(colliders.probe(beside.position, r).gap >= 0.0);
            }
        }
    }
    stabilityRow("radius", "0 to 50 voxels", "relative error of a bounce's height", worst);
}

TEST_CASE("restitution and friction at the ends of their ranges", "[extremes]")
{
    double worst = 0.0;
    for (const Ground& ground : grounds(kUp)) {
        for (double e : {0.0, 1.0}) {
            for (double mu : {0.0, 1e6}) {
                INFO(ground.name << ", restitution " << e << ", mu " << mu);
                const StillColliders colliders = single(ground, e, mu);
                const StepOptions options = millisecond();
                MovingParticle particle =
                    placed(Vec3d(-0.8, kGroundOffset + 0.3, 0.1), Vec3d(0.4, 0, 0), colliders, 0.02);
                StepTally tally(1);
                const double whole = energy(particle, options.gravity);
                double before = whole;
                for (int s = 0; s < 3000; ++s) {
                    step(particle, colliders, options, tally);
                    REQUIRE(colliders.probe(particle.position, 0.02).gap >= 0.0);
                    const double now = energy(particle, options.gravity);
                    worst = std::max(worst, now - before);
                    REQUIRE(now <= before + 1e-12);
                    before = now;
                }
                if (e == 1.0 && mu == 0.0) CHECK(before == Approx(whole).epsilon(1e-9));
                if (e == 0.0) CHECK(std::abs(particle.velocity.y()) <= 1e-6);
                CHECK(particle.velocity.x() == Approx(mu == 0.0 ? 0.4 : 0.0).margin(1e-5));
            }
        }
    }
    stabilityRow("restitution and friction", "0 and 1, 0 and 1e6", "most energy gained in a step, J a kg", worst);
}

TEST_CASE("masses from 1e-12 to 1e12", "[extremes]")
{
    const Shape ball = fieldOf(sphere(0.5), uniformTransform(kVoxel), 14);
    double worstImpulse = 0.0;
    double worstMomentum = 0.0;
    double worstAnswer = 0.0;
    for (double mass : {1e-12, 1e-6, 1.0, 1e6, 1e12}) {
        INFO("mass " << mass);
        PassOptions options;
        options.step = millisecond();
        options.step.gravity = Vec3d::Zero();
        options.defaults = {0.02, mass};
        Particles start;
        start.resize(1);
        start.position[0] = Vec3d(-1, 0, 0);
        start.ensureVelocity();
        start.velocity[0] = Vec3d(3, 0, 0);

        Collider thing{"ball", ball, 0.7, 0.2};
        Particles particles = start;
        const ColliderSet fixed({thing});
        const PassReport report = ParticlePass(particles, fixed, options).advance(400);
        const Vec3d change = mass * (particles.velocity[0] - start.velocity[0]);
        const double impulseError = (change + report.tally.impulse[0]).norm() / (3.0 * mass);
        worstImpulse = std::max(worstImpulse, impulseError);
        CHECK(impulseError <= 1e-14);

        thing.body = evenDensity(ball, 1.0);
        const ColliderSet free({thing});
        particles = start;
        ParticlePass pass(particles, free, options);
        pass.advance(400);
        const RigidVelocity after = pass.bodies()[0]->velocity();
        const double sum = particles.velocity[0].x() * mass + after.linear.x();
        worstMomentum = std::max(worstMomentum, std::abs(sum / (3.0 * mass) - 1.0));
        CHECK(sum == Approx(3.0 * mass).epsilon(1e-12));
        const double expected = 3.0 * 1.7 * mass / (mass + 1.0);
        worstAnswer = std::max(worstAnswer, std::abs(after.linear.x() / expected - 1.0));
        CHECK(after.linear.x() == Approx(expected).epsilon(0.01));
    }
    const std::string range = "1e-12 to 1e12, of a free body 1";
    stabilityRow("mass", range, "relative error of the impulse that is reported", worstImpulse);
    stabilityRow("mass", range, "relative error of the momentum together", worstMomentum);
    stabilityRow("mass", range, "relative error of the body's velocity", worstAnswer);
}

TEST_CASE("walls of two voxels hold, and how much thinner ones leak", "[extremes]")
{
    for (double thickness : {2.0, 1.0, 0.5}) {
        const int leaks = leaksOf(fieldOf(plate(thickness), uniformTransform(kVoxel), 26), 1000, -1, 7, passesPlate);
        std::ostringstream range;
        range << thickness << " voxels";
        stabilityRow("thickness of a plate", range.str(), "leaks of 1000 shots, 0.1 to 1e7 voxels a step", leaks);
        if (thickness >= 2.0) CHECK(leaks == 0);
    }
}
