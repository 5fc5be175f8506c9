// SPDX-License-Identifier: Apache-2.0
#include "support/meshes.h"
#include "support/random.h"

#include "vdbounce/base/triangle_distance.h"
#include "vdbounce/build/mesh_tree.h"

#include <Eigen/Geometry>

using namespace vdbounce;
using namespace vdbounce::test;

TEST_CASE("the closest point of a triangle is no farther than any of its points, slivers included")
{
    VDBOUNCE_RANDOM(random);
    const Box box{Vec3d::Constant(-1), Vec3d::Constant(1)};
    for (int i = 0; i < 20000; ++i) {
        const Vec3d a = random.in(box);
        Vec3d b = random.in(box);
        Vec3d c = random.in(box);
        if (i % 4 == 1) c = a + random.uniform(-1, 2) * (b - a);                            // all on a line
        if (i % 4 == 2) c = a + random.uniform(0, 1) * (b - a) + 1e-9 * random.direction(); // nearly
        if (i % 40 == 3) b = c = a;                                                         // a point
        const Vec3d p = 2.0 * random.in(box);
        const double distance = (closestPointOnTriangle(p, a, b, c) - p).norm();
        for (int k = 0; k < 20; ++k) {
            double u = random.uniform(0, 1);
            double v = random.uniform(0, 1);
            if (u + v > 1) u = 1 - u, v = 1 - v;
            REQUIRE((a + u * (b - a) + v * (c - a) - p).norm() >= distance - 1e-12);
        }
        REQUIRE(distance <= std::min({(a - p).norm(), (b - p).norm(), (c - p).norm()}) + 1e-15);
    }
}

TEST_CASE("the tree finds the same distance as asking every triangle")
{
    VDBOUNCE_RANDOM(random);
    const TriangleMesh mesh = joined(sphereMesh(1.0, 3), boxMesh(Vec3d(0.3, 0.2, 0.9), Vec3d(1.5, 0, 0)));
    const MeshTree tree(mesh);
    for (int i = 0; i < 2000; ++i) {
        const Vec3d p = random.in(Box{Vec3d::Constant(-3), Vec3d::Constant(3)});
        const auto closest = tree.closest(p);
        REQUIRE(closest.distance == Approx(bruteForceDistance(mesh, p)).epsilon(1e-14));
        REQUIRE((closest.point - p).norm() == Approx(closest.distance).margin(1e-14));
    }
}

TEST_CASE("winding number and parity know inside from outside")
{
    VDBOUNCE_RANDOM(random);
    const TriangleMesh mesh = joined(sphereMesh(1.0, 4), flipped(sphereMesh(0.5, 4)));
    const MeshTree tree(mesh);
    for (int i = 0; i < 3000; ++i) {
        const Vec3d p = random.in(Box{Vec3d::Constant(-1.5), Vec3d::Constant(1.5)});
        const double r = p.norm();
        if (std::abs(r - 1.0) < 0.02 || std::abs(r - 0.5) < 0.02) continue;
        const bool inside = r < 1.0 && r > 0.5;
        REQUIRE(std::abs(tree.windingNumber(p) - (inside ? 1.0 : 0.0)) < 0.05);
        REQUIRE(tree.insideByParity(p) == inside);
    }
}
