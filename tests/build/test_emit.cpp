// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"

#include "vdbounce/base/error.h"
#include "vdbounce/build/emit.h"

#include <catch2/catch.hpp>

#include <tbb/global_control.h>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

EmitOptions count(std::uint64_t n)
{
    EmitOptions options;
    options.count = n;
    return options;
}

} // namespace

TEST_CASE("particles fill a box and a ball evenly")
{
    const Box box{Vec3d(-1, 2, 3), Vec3d(1, 6, 3.5)};
    const Particles inBox = emitInBox(box, count(40000));
    Vec3d mean = Vec3d::Zero();
    for (const Vec3d& p : inBox.position) {
        REQUIRE(box.contains(p));
        mean += p / 40000.0;
    }
    CHECK((mean - box.centre()).cwiseAbs().cwiseQuotient(box.size()).maxCoeff() < 0.01);

    const Particles inBall = emitInSphere(Vec3d(1, 2, 3), 2.0, count(40000));
    int inner = 0;
    for (const Vec3d& p : inBall.position) {
        const double r = (p - Vec3d(1, 2, 3)).norm();
        REQUIRE(r <= 2.0);
        if (r <= 1.0) ++inner;
    }
    CHECK(inner == Approx(5000).epsilon(0.05)); // an eighth of the volume
}

TEST_CASE("particles lie on a surface, evenly by area")
{
    const DistanceField field(levelSet(bandGrid(sphere(1.0), uniformTransform(0.05), 26)));
    const Particles particles = emitOnSurface(field, 0.05, count(40000));
    int upper = 0;
    for (const Vec3d& p : particles.position) {
        REQUIRE(std::abs(p.norm() - 1.05) < 0.05 * 0.05);
        if (p.z() > 0.5 * 1.05) ++upper;
    }
    CHECK(upper == Approx(10000).epsilon(0.06)); // Archimedes: a quarter of the area
    CHECK_THROWS_AS(emitOnSurface(field, 0.5, count(10)), InputError);
}

TEST_CASE("a seed decides everything, the number of threads nothing")
{
    const Box box{Vec3d::Zero(), Vec3d::Ones()};
    EmitOptions options = count(30000);
    const Particles a = emitInBox(box, options);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    CHECK(a.position == emitInBox(box, options).position);
    options.seed = 2;
    CHECK(a.position != emitInBox(box, options).position);
}

TEST_CASE("emitted particles carry what was asked for")
{
    EmitOptions options = count(3);
    options.velocity = Vec3d(1, 2, 3);
    options.radius = 0.5;
    const Particles particles = emitInBox(Box{Vec3d::Zero(), Vec3d::Ones()}, options);
    CHECK(particles.velocity == std::vector<Vec3d>(3, Vec3d(1, 2, 3)));
    CHECK(particles.radius == std::vector<double>(3, 0.5));
    CHECK(particles.mass.empty());
    CHECK(particles.id == std::vector<std::int64_t>{0, 1, 2});
    options.radius = -1.0;
    CHECK_THROWS_AS(emitInBox(Box{Vec3d::Zero(), Vec3d::Ones()}, options), UsageError);
    CHECK_THROWS_AS(emitInBox(Box{Vec3d::Ones(), Vec3d::Zero()}, count(3)), UsageError);
}
