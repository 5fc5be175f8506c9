// SPDX-License-Identifier: Apache-2.0
#include "support/fields.h"
#include "support/grounds.h"
#include "support/one_particle.h"
#include "support/random.h"
#include "support/stability_table.h"
#include "support/step_options.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

/// @file
/// Numbers next to zero, and grids with no surface or next to none. Each test writes what it measured by
/// stabilityRow().

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

constexpr double kVoxel = 0.05;

} // namespace

TEST_CASE("the smallest numbers, and zeros of either sign", "[extremes]")
{
    const double tiny = std::numeric_limits<double>::denorm_min();
    const double small = std::numeric_limits<double>::min();
    const Phi phi = halfSpace(kUp);
    const Ground list[] = {{"plane", PlaneField(Vec3d::Zero(), kUp)},
                           {"level set", fieldOf(phi, uniformTransform(kVoxel), 10)}};
    for (const Ground& ground : list) {
        const StillColliders colliders = single(ground, 0.5, 0.3);
        for (double length : {0.0, -0.0, tiny, small, 1e-200}) {
            for (double speed : {0.0, -0.0, tiny, -tiny, small, -small, 1e-200, -1e-200}) {
                for (bool weight : {false, true}) {
                    INFO(ground.name << ", at " << length << ", speed " << speed << ", weight " << weight);
                    StepOptions options = millisecond();
                    if (!weight) options.gravity = Vec3d(0, -0.0, 0);
                    MovingParticle particle =
                        placed(Vec3d(-length, length, tiny), Vec3d(speed, speed, -speed), colliders, 0.0);
                    REQUIRE_FALSE(particle.inside);
                    StepTally tally(1);
                    for (int s = 0; s < 50; ++s) {
                        step(particle, colliders, options, tally);
                        REQUIRE(particle.position.allFinite());
                        REQUIRE(particle.velocity.allFinite());
                        // The square of less than this is 0, and so is the length that the root of it tells.
                        REQUIRE(colliders.probe(particle.position, 0.0).gap >= -1e-150);
                    }
                    CHECK(particle.position.norm() <= 1e-6 * kVoxel);
                    CHECK(particle.velocity.norm() <= 1e-6);
                }
            }
        }
    }
    stabilityRow("places and speeds next to 0", "5e-324 to 1e-200, 0 and -0",
                 "not finite, or deeper inside than 1e-150", 0);
}

TEST_CASE("grids without a surface, or with next to none", "[extremes]")
{
    openvdb::initialize();
    const auto grid = [](float background) {
        auto result = openvdb::FloatGrid::create(background);
        result->setTransform(uniformTransform(kVoxel));
        result->setGridClass(openvdb::GRID_LEVEL_SET);
        return result;
    };
    const auto cube = [](const openvdb::FloatGrid::Ptr& into, float value) {
        into->denseFill(openvdb::CoordBBox(openvdb::Coord(-6), openvdb::Coord(6)), value, true);
        return into;
    };
    const auto oneVoxel = [](const openvdb::FloatGrid::Ptr& into, float value) {
        into->tree().setValueOn(openvdb::Coord(0), value);
        return into;
    };
    struct Case {
        const char* name;
        openvdb::FloatGrid::Ptr grid;
    };
    const Case cases[] = {{"empty", grid(0.15f)},
                          {"one voxel, outside", oneVoxel(grid(0.15f), 0.05f)},
                          {"one voxel, inside", oneVoxel(grid(0.15f), -0.05f)},
                          {"all inside", cube(grid(0.15f), -0.15f)},
                          {"all outside", cube(grid(0.15f), 0.15f)}};
    VDBOUNCE_RANDOM(random);
    for (const Case& thing : cases) {
        const auto field = std::make_shared<const DistanceField>(levelSet(thing.grid));
        for (Scheme scheme : {Scheme::CollideContact, Scheme::Iterate, Scheme::Once}) {
            for (int i = 0; i < 100; ++i) {
                const StillColliders colliders({{"thing", field, random.uniform(0, 1), random.uniform(0, 1)}});
                const Vec3d from = random.uniform(0.0, 1.0) * random.direction();
                MovingParticle particle =
                    placed(from, -std::pow(10.0, random.uniform(-1, 5)) * from, colliders, i % 2 == 0 ? 0.0 : 0.02);
                const bool outside = !particle.inside;
                StepOptions options = millisecond();
                options.scheme = scheme;
                StepTally tally(1);
                for (int s = 0; s < 50; ++s) {
                    step(particle, colliders, options, tally);
                    INFO(thing.name << ", from " << from.transpose() << ", step " << s << ", scheme " << int(scheme));
                    REQUIRE(particle.position.allFinite());
                    REQUIRE(particle.velocity.allFinite());
                    if (outside && scheme != Scheme::Once)
                        REQUIRE(colliders.probe(particle.position, particle.radius).gap >= 0.0);
                }
            }
        }
    }
    stabilityRow("grids without a surface", "empty, one voxel, all inside, all outside", "not finite, or went inside",
                 0);
}
