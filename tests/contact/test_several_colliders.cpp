// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/one_particle.h"
#include "support/random.h"
#include "support/still_colliders.h"

#include <cmath>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

using FieldPtr = std::shared_ptr<const DistanceField>;

FieldPtr fieldOf(const Phi& phi, int side = 40)
{
    auto turned = uniformTransform(0.05);
    turned->postRotate(0.4, openvdb::math::X_AXIS);
    turned->postRotate(0.3, openvdb::math::Z_AXIS);
    return std::make_shared<const DistanceField>(levelSet(bandGrid(phi, turned, side, 5.0)));
}

Collider wall(const Vec3d& normal, bool plane)
{
    if (plane) return {"wall", PlaneField(Vec3d::Zero(), normal), 0.3, 0.4};
    return {"wall", fieldOf(halfSpace(normal)), 0.3, 0.4};
}

// A cone of steep walls with a hole narrower than the particle.
Phi funnel(double radius)
{
    return [=](const Vec3d& p) {
        const double across = std::hypot(p.x(), p.z());
        return (p.y() - 1.5 * (across - radius)) / std::sqrt(1.0 + 1.5 * 1.5);
    };
}

} // namespace

TEST_CASE("in wedges, corners and funnels particles come to rest, resolved in every step, and keep their place")
{
    std::vector<std::pair<const char*, std::vector<Collider>>> scenes;
    for (bool plane : {true, false}) {
        const char* kind = plane ? "planes" : "level sets";
        scenes.push_back({kind, {wall(Vec3d(1, 1, 0), plane), wall(Vec3d(-1, 1, 0), plane)}});
        scenes.push_back({kind, {wall(Vec3d(1, 0.4, 0), plane), wall(Vec3d(-1, 0.6, 0.1), plane)}});
        scenes.push_back({kind,
                          {wall(Vec3d(1, 1, 0.1), plane), wall(Vec3d(-1, 1, 0), plane), wall(Vec3d(0, 1, 1), plane),
                           wall(Vec3d(0, 1, -1), plane)}});
    }
    scenes.push_back({"one level set", {{"funnel", fieldOf(funnel(0.1)), 0.3, 0.4}}});
    for (const auto& [name, list] : scenes) {
        const StillColliders colliders(list);
        StepOptions options;
        options.dt = 2e-3;
        INFO(name << ", " << list.size() << " colliders");
        for (const Vec3d& from : {Vec3d(0.05, 0.6, 0.03), Vec3d(-0.02, 0.5, -0.01), Vec3d(0.2, 0.7, 0.0)}) {
            MovingParticle particle = placed(from, Vec3d(0.1, 0, 0.2), colliders, 0.15);
            REQUIRE_FALSE(particle.inside);
            StepTally tally(colliders.size());
            for (int s = 0; s < 10000; ++s) step(particle, colliders, options, tally);
            const Vec3d resting = particle.position;
            INFO("from " << from.transpose() << " to " << resting.transpose() << ", velocity "
                         << particle.velocity.transpose() << ", unresolved " << tally.unresolved);
            tally = StepTally(colliders.size());
            for (int s = 0; s < 2000; ++s) step(particle, colliders, options, tally);
            CHECK((particle.position - resting).norm() < 1e-3 * 0.05);
            CHECK(particle.velocity.norm() < 1e-6);
            CHECK(tally.unresolved == 0);
            CHECK(colliders.probe(particle.position, 0.15).gap >= 0.0);
        }
    }
}

TEST_CASE("of 64 colliders those that are near answer as all of them would")
{
    VDBOUNCE_RANDOM(random);
    const FieldPtr ball = fieldOf(sphere(0.3), 12);
    std::vector<Collider> list;
    for (int i = 0; i < 64; ++i) {
        Motion::Constant motion;
        motion.centre = Vec3d::Zero();
        Motion::Key key;
        key.translate = 0.9 * Vec3d(i / 16, i / 4 % 4, i % 4);
        list.push_back({"ball", ball, 0.5, 0.3, OnHit::Bounce, Motion(std::vector<Motion::Key>{key})});
    }
    const ColliderSet set(list);
    const PlacedColliders placed(set, 0.0, 0.01);
    for (int i = 0; i < 5000; ++i) {
        const Vec3d p = random.in(Box{Vec3d::Constant(-1), Vec3d::Constant(4)});
        const double radius = random.uniform(0, 0.2);
        double nearest = 1e9;
        for (const Collider& collider : list)
            nearest = std::min(nearest, ball->phi(p - collider.motion.poseAt(0.0).translation) - radius);
        const Probe probe = placed.probe(p, radius);
        if (nearest < 0.2) REQUIRE(probe.gap == Approx(nearest).margin(1e-12));
        REQUIRE(probe.clearance <= std::max(0.0, nearest) + 1e-12);
        // Nothing touches within the clearance.
        const Vec3d there = p + 0.999 * probe.clearance * random.direction();
        REQUIRE(placed.probe(there, radius).gap >= std::min(0.0, nearest) - 1e-12);
    }
}
