// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/random.h"
#include "support/still_colliders.h"

#include "vdbounce/contact/step.h"
#include "vdbounce/contact/sweep.h"

#include <cmath>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

StillColliders one(const LevelSetGrid& grid)
{
    return StillColliders({{"thing", std::make_shared<const DistanceField>(grid), 0.5, 0.2}});
}

// A square plate, `thicknessVx` voxels of 0.05 thick, in the plane y = 0.013.
LevelSetGrid plate(double thicknessVx)
{
    const Phi phi = [=](const Vec3d& p) {
        const Vec3d d =
            Vec3d(std::abs(p.x()), std::abs(p.y() - 0.013), std::abs(p.z())) - Vec3d(1, 0.5 * thicknessVx * 0.05, 1);
        return d.cwiseMax(0.0).norm() + std::min(0.0, d.maxCoeff());
    };
    return levelSet(bandGrid(phi, uniformTransform(0.05), 26));
}

} // namespace

TEST_CASE("a path finds the first point of a sphere that it meets")
{
    VDBOUNCE_RANDOM(random);
    const StillColliders colliders = one(levelSet(bandGrid(sphere(1.0), uniformTransform(0.04), 30)));
    for (int i = 0; i < 5000; ++i) {
        const Vec3d from = 3.0 * random.direction();
        const Vec3d aim = 0.8 * random.direction();
        const Vec3d to = from + 3.0 * (aim - from);
        const double radius = i % 2 == 0 ? 0.0 : 0.05;
        const PathHit hit = sweepPath(colliders, from, to, radius);
        REQUIRE(hit.hit);
        REQUIRE(hit.position.norm() == Approx(1.0 + radius).margin(5e-3));
        REQUIRE(hit.position.dot(to - from) < 0.0); // on the near side
        REQUIRE(colliders.probe(hit.position, radius).gap >= 0.0);
    }
    CHECK_FALSE(sweepPath(colliders, Vec3d(-3, 1.2, 0), Vec3d(3, 1.2, 0), 0.0).hit);
    CHECK_FALSE(sweepPath(colliders, Vec3d(2, 0, 0), Vec3d(2, 0, 0), 0.0).hit);
}

TEST_CASE("no particle passes a plate two voxels thick at any speed")
{
    VDBOUNCE_RANDOM(random);
    const StillColliders colliders = one(plate(2.0));
    StepOptions options;
    options.gravity = Vec3d::Zero();
    options.dt = 0.01;
    for (int i = 0; i < 20000; ++i) {
        MovingParticle particle;
        particle.position = Vec3d(random.uniform(-0.8, 0.8), random.uniform(0.1, 3), random.uniform(-0.8, 0.8));
        const Vec3d target(random.uniform(-0.8, 0.8), 0.0, random.uniform(-0.8, 0.8));
        particle.velocity = std::pow(10.0, random.uniform(-1, 7)) * (target - particle.position).normalized();
        settle(particle, colliders);
        StepTally tally(1);
        for (int s = 0; s < 40; ++s) step(particle, colliders, options, tally);
        INFO("ends at " << particle.position.transpose());
        const bool beside = particle.position.cwiseAbs().x() > 1.0 || particle.position.cwiseAbs().z() > 1.0;
        REQUIRE((particle.position.y() > 0.0 || beside));
        REQUIRE(tally.unresolved == 0);
    }
}

TEST_CASE("a deforming wall is found behind whatever else is on the way")
{
    VDBOUNCE_RANDOM(random);
    const Phi thin = [](const Vec3d& p) { return std::abs(p.y()) - 0.05; };
    const auto wall = std::make_shared<const DistanceField>(levelSet(bandGrid(thin, uniformTransform(0.05), 24)));
    DeformingShape deforming;
    deforming.field = std::make_shared<const DeformingField>(wall, wall, 1.0);
    deforming.end = 1.0;
    const ColliderSet set(
        {{"floor", PlaneField(Vec3d(0, -0.06, 0), Vec3d(0, 1, 0)), 0.5, 0.2}, {"wall", deforming, 0.5, 0.2}});
    const PlacedColliders colliders(set, 0.0, 0.01);
    for (int i = 0; i < 1000; ++i) {
        const Vec3d from(random.uniform(-0.5, 0.5), random.uniform(0.5, 1), random.uniform(-0.5, 0.5));
        const PathHit hit = sweepPath(colliders, from, from - Vec3d(0, std::pow(10.0, random.uniform(0.3, 3)), 0), 0.0);
        REQUIRE(hit.hit);
        REQUIRE(hit.collider == 1);
    }
}
