// SPDX-License-Identifier: Apache-2.0
#include "support/fields.h"
#include "support/grounds.h"
#include "support/moving_scene.h"
#include "support/random.h"
#include "support/step_options.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

Phi box(const Vec3d& low, const Vec3d& high)
{
    return [=](const Vec3d& p) {
        const Vec3d d = (p - 0.5 * (low + high)).cwiseAbs() - 0.5 * (high - low);
        return d.cwiseMax(0.0).norm() + std::min(0.0, d.maxCoeff());
    };
}

} // namespace

TEST_CASE("a floor that rises at a constant speed throws a resting particle up with twice that speed")
{
    for (const Ground& ground : grounds(kUp)) {
        for (double speed : {0.1, 2.0, 500.0}) {
            INFO(ground.name << ", speed " << speed);
            MovingScene scene({collider(ground.shape, 1.0, 0.3, moving(Vec3d(0, speed, 0)))}, weightless(1e-3));
            MovingParticle particle = scene.particle(Vec3d(0.1, kGroundOffset + 0.0522, 0.2), Vec3d::Zero(), 0.02);
            while (scene.tally().contacts == 0 && scene.time() < 1.0) scene.advance(particle);
            CHECK((particle.velocity - Vec3d(0, 2 * speed, 0)).norm() <= 1e-4 * speed);
            for (int s = 0; s < 100; ++s) scene.advance(particle);
            CHECK(scene.tally().contacts == 1);
            CHECK(scene.gap(particle) > 0.0);
        }
    }
}

TEST_CASE("a platform drags a particle along by mu g until it moves with it")
{
    const double mu = 0.3;
    const Vec3d velocity(0.8, 0, -0.6);
    for (const Ground& ground : grounds(kUp)) {
        INFO(ground.name);
        MovingScene scene({collider(ground.shape, 0.2, mu, moving(velocity))}, millisecond());
        MovingParticle particle = scene.particle(Vec3d(0, kGroundOffset, 0), Vec3d::Zero());
        while (scene.time() < 0.2) scene.advance(particle);
        CHECK((particle.velocity - mu * kGravity * 0.2 * velocity).norm() <= 0.01 * mu * kGravity * 0.2);
        while (scene.time() < 0.345) scene.advance(particle);
        const Vec3d rests = scene.placement().end.toLocal(particle.position);
        CHECK((particle.velocity - velocity).norm() <= 1e-12);
        // What it slid back by while it was slower.
        CHECK((rests + velocity / (2 * mu * kGravity)).head<1>().norm() <= 0.01 / (2 * mu * kGravity));
        while (scene.time() < 1.0) scene.advance(particle);
        CHECK((scene.placement().end.toLocal(particle.position) - rests).norm() <= 1e-6 * kGroundVoxel);
        CHECK((particle.velocity - velocity).norm() <= 1e-12);
    }
}

TEST_CASE("on a turntable a particle rests exactly while omega^2 r < mu g, and moves along")
{
    const double mu = 0.5;
    const double omega = 3.0;
    const double limit = mu * kGravity / (omega * omega);
    for (const Ground& ground : grounds(kUp)) {
        for (double share : {0.3, 0.6, 0.98, 1.02}) {
            INFO(ground.name << ", " << share << " of the largest radius");
            const double r = share * limit;
            MovingScene scene({collider(ground.shape, 0.3, mu, moving(Vec3d::Zero(), Vec3d(0, omega, 0)))},
                              millisecond());
            MovingParticle particle = scene.particle(Vec3d(r, kGroundOffset, 0), Vec3d(0, 0, -omega * r));
            while (scene.time() < 2 * M_PI / omega) scene.advance(particle);
            const Vec3d local = scene.placement().end.toLocal(particle.position);
            const double drift = std::hypot(local.x(), local.z()) - r;
            if (share < 1.0) {
                CHECK(std::abs(drift) < 1e-6);
                CHECK((local - Vec3d(r, kGroundOffset, 0)).norm() < 1e-6);
            } else {
                CHECK(drift > 0.01);
            }
        }
    }
}

TEST_CASE("a paddle that turns about its end gives a particle (1 + e) times its speed there, whatever both share")
{
    const auto paddle = fieldOf(box(Vec3d(0, -0.1, -0.3), Vec3d(1, 0.1, 0.3)), 0.04, 32);
    const double omega = 2.0;
    for (const Vec3d& shared : {Vec3d(0, 0, 0), Vec3d(3, -1, 2), Vec3d(300, -100, 200)}) {
        for (double e : {0.0, 0.6, 1.0}) {
            INFO("restitution " << e << ", both move by " << shared.transpose());
            MovingScene scene({collider(paddle, e, 0.0, moving(shared, Vec3d(0, 0, omega)))}, weightless(1e-3));
            MovingParticle particle = scene.particle(Vec3d(0.7, 0.3, 0.02), shared);
            while (scene.tally().contacts == 0 && scene.time() < 1.0) scene.advance(particle);
            // It is met by the face that is 0.1 above the middle.
            const double arm = std::sqrt(0.7 * 0.7 + 0.3 * 0.3 - 0.1 * 0.1);
            const double angle = std::atan2(0.3, 0.7) - std::atan2(0.1, arm);
            const Vec3d expected = (1.0 + e) * omega * arm * Vec3d(-std::sin(angle), std::cos(angle), 0.0);
            CHECK(scene.time() == Approx(angle / omega).margin(1.1e-3));
            CHECK((particle.velocity - shared - expected).norm() <= 0.01 * expected.norm());
        }
    }
}

TEST_CASE("a floor that is keyed through a particle's place in one step carries it up")
{
    for (const Ground& ground : grounds(kUp)) {
        for (double lift : {0.01, 0.5, 40.0}) {
            INFO(ground.name << ", lifted by " << lift);
            const StepOptions options;
            std::vector<Motion::Key> keys(2);
            keys[1].time = options.dt;
            keys[1].translate = Vec3d(0, lift, 0);
            MovingScene scene({collider(ground.shape, 0.0, 0.5, Motion(keys))}, options);
            MovingParticle particle = scene.particle(Vec3d(0.1, kGroundOffset + 0.021, 0), Vec3d::Zero(), 0.02);
            for (int s = 0; s < 20; ++s) {
                scene.advance(particle);
                REQUIRE(scene.gap(particle) >= 0.0);
                REQUIRE(particle.position.y() >= lift);
            }
        }
    }
}

TEST_CASE("motion by keys equals the constant motion that they describe")
{
    VDBOUNCE_RANDOM(random);
    const Vec3d velocity(0.3, 0.2, -0.1);
    const Vec3d angular(0.4, -1.1, 0.6);
    std::vector<Motion::Key> keys(11);
    for (std::size_t k = 0; k < keys.size(); ++k) {
        const double time = 0.1 * double(k);
        keys[k] = {time, time * velocity,
                   Eigen::Quaterniond(Eigen::AngleAxisd(time * angular.norm(), angular.normalized()))};
    }
    const Motion constant = moving(velocity, angular);
    const Motion keyed(keys);
    for (int i = 0; i < 100; ++i) {
        const double time = random.uniform(0, 1);
        const Vec3d p = random.direction();
        REQUIRE((constant.poseAt(time).toWorld(p) - keyed.poseAt(time).toWorld(p)).norm() < 1e-14);
        REQUIRE((constant.velocityAt(time).at(p) - keyed.velocityAt(time).at(p)).norm() < 1e-13);
    }
    const auto block = fieldOf(box(Vec3d(-0.5, -0.3, -0.6), Vec3d(0.5, 0.3, 0.6)), 0.05, 18);
    std::uint64_t contacts = 0;
    for (int i = 0; i < 30; ++i) {
        MovingScene a({collider(block, 0.5, 0.3, constant)}, millisecond());
        MovingScene b({collider(block, 0.5, 0.3, keyed)}, millisecond());
        MovingParticle one = a.particle(random.in(Box{Vec3d(-0.5, 0.35, -0.5), Vec3d(0.5, 0.6, 0.5)}), Vec3d::Zero());
        MovingParticle other = one;
        while (a.time() < 0.99) {
            a.advance(one);
            b.advance(other);
        }
        contacts += a.tally().contacts;
        // Rounding decides in which of two steps a contact falls, and with it about g dt.
        CHECK((one.position - other.position).norm() < 1e-2 * 0.05);
        CHECK((one.velocity - other.velocity).norm() < 2.0 * kGravity * 1e-3);
    }
    CHECK(contacts > 30);
}

TEST_CASE("a plate two voxels thick that moves and turns passes through no particle")
{
    VDBOUNCE_RANDOM(random);
    const double voxel = 0.05;
    const double middle = 0.013;
    const double side = 1.0;
    const auto plate = fieldOf(box(Vec3d(-side, middle - voxel, -side), Vec3d(side, middle + voxel, side)), voxel, 26);
    const double dt = 0.01;
    int met = 0;
    for (int i = 0; i < 1500; ++i) {
        const Vec3d velocity = voxel / dt * std::pow(10.0, random.uniform(-1, 6)) * random.direction();
        // Up to half a turn a step, beyond which nobody can tell which way it turned.
        const Vec3d angular = (i % 3 == 0 ? 0.0 : random.uniform(0, 1) / dt) * random.direction();
        const Vec3d own = i % 2 == 0 ? Vec3d(Vec3d::Zero())
                                     : Vec3d(voxel / dt * std::pow(10.0, random.uniform(-1, 6)) * random.direction());
        const double radius = i % 4 < 2 ? 0.0 : random.uniform(0, voxel);
        const Motion motion = moving(velocity, angular);
        MovingScene scene({collider(plate, random.uniform(0, 1), random.uniform(0, 1), motion)}, weightless(dt));
        // Where it must be now so that it lies in the plate at some time of the next four steps.
        const double when = random.uniform(0, 4) * dt;
        const Vec3d target(random.uniform(-0.8, 0.8) * side, middle, random.uniform(-0.8, 0.8) * side);
        MovingParticle particle = scene.particle(motion.poseAt(when).toWorld(target) - when * own, own, radius);
        if (particle.inside) continue;
        for (int s = 0; s < 8; ++s) {
            const Vec3d start = particle.position;
            scene.advance(particle);
            INFO("plate " << i << ", step " << s << ", velocity " << velocity.transpose() << ", angular "
                          << angular.transpose() << ", particle " << own.transpose() << ", radius " << radius);
            REQUIRE(scene.gap(particle) >= 0.0);
            const Placement& placement = scene.placement();
            const auto at = [&](double share) {
                return placement.between(share).toLocal(start + share * (particle.position - start));
            };
            double before = 0.0;
            double after = 1.0;
            const double sign = at(0.0).y() - middle;
            if (sign * (at(1.0).y() - middle) >= 0.0) continue;
            for (int k = 0; k < 60; ++k) {
                const double between = 0.5 * (before + after);
                (sign * (at(between).y() - middle) > 0.0 ? before : after) = between;
            }
            const Vec3d crossing = at(before).cwiseAbs();
            REQUIRE(std::max(crossing.x(), crossing.z()) > side - 1.5 * voxel);
        }
        met += scene.tally().contacts > 0 ? 1 : 0;
    }
    CHECK(met > 1000);
}

TEST_CASE("a sphere that grows pushes particles out at the speed of its surface")
{
    VDBOUNCE_RANDOM(random);
    const double seconds = 0.5;
    const double speed = 0.2;
    // Two voxels in all, so the band is wide enough for the one where the other has its surface, and around it.
    const auto field = std::make_shared<const DeformingField>(
        fieldOf(sphere(0.5), 0.05, 20, 5.0), fieldOf(sphere(0.5 + speed * seconds), 0.05, 20, 5.0), seconds);
    for (int i = 0; i < 2000; ++i) {
        const double share = random.uniform(0, 1);
        const Vec3d outward = random.direction();
        const double r = 0.5 + share * speed * seconds + random.uniform(-0.05, 0.05);
        REQUIRE((field->velocity(r * outward, share) - speed * outward).norm() <= 0.05 * speed);
    }
    for (double e : {0.0, 0.5}) {
        for (int i = 0; i < 50; ++i) {
            MovingScene scene({collider(DeformingShape{field, 0.0, seconds}, e, 0.3, Motion())}, weightless(2e-3));
            const Vec3d outward = random.direction();
            MovingParticle particle = scene.particle(0.55 * outward, Vec3d::Zero(), i % 2 == 0 ? 0.0 : 0.02);
            while (scene.time() < seconds) {
                scene.advance(particle);
                INFO("restitution " << e << ", towards " << outward.transpose() << ", at " << scene.time());
                REQUIRE(scene.gap(particle) >= 0.0);
            }
            INFO("restitution " << e << ", towards " << outward.transpose());
            CHECK((particle.velocity - (1.0 + e) * speed * outward).norm() <= 0.1 * speed);
        }
    }
}
