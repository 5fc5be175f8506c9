// SPDX-License-Identifier: Apache-2.0
#include "support/random.h"

#include "vdbounce/contact/response.h"

#include <cmath>

using namespace vdbounce;
using test::Random;

TEST_CASE("a collision reverses the normal velocity by its restitution")
{
    const Vec3d n(0, 1, 0);
    CHECK(respond(Vec3d(0, -2, 0), n, 0.5, 0.0) == Vec3d(0, 1, 0));
    CHECK(respond(Vec3d(3, -2, 0), n, 1.0, 0.0) == Vec3d(3, 2, 0));
    CHECK(respond(Vec3d(3, -2, 0), n, 0.0, 0.0) == Vec3d(3, 0, 0));
}

TEST_CASE("what moves away is left alone")
{
    const Vec3d w(1, 0.5, -2);
    CHECK(respond(w, Vec3d(0, 1, 0), 0.5, 10.0) == w);
    CHECK(respond(Vec3d(1, 0, 0), Vec3d(0, 1, 0), 0.5, 10.0) == Vec3d(1, 0, 0));
}

TEST_CASE("oblique impact keeps max(0, 1 - mu (1+e) / tan theta) of the tangential velocity")
{
    VDBOUNCE_RANDOM(random);
    for (int i = 0; i < 10000; ++i) {
        const Vec3d n = random.direction();
        const Vec3d w = random.uniform(0.1, 10) * random.direction();
        const double e = random.uniform(0, 1);
        const double mu = random.uniform(0, 1.5);
        const double normal = -w.dot(n);
        if (normal <= 0.0) continue;
        const Vec3d tangential = w + normal * n;
        const double tanTheta = tangential.norm() / normal;
        const double kept = std::max(0.0, 1.0 - mu * (1.0 + e) / tanTheta);
        const Vec3d after = respond(w, n, e, mu);
        REQUIRE((after - (kept * tangential + e * normal * n)).norm() < 1e-12);
        REQUIRE(after.squaredNorm() <= w.squaredNorm() * (1.0 + 1e-14));
        if (kept == 0.0 && e == 0.0) REQUIRE(after == Vec3d::Zero());
    }
}
