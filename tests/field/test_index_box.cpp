// SPDX-License-Identifier: Apache-2.0
#include "support/random.h"

#include "vdbounce/field/index_box.h"

#include <Eigen/Geometry>

using namespace vdbounce;

TEST_CASE("the closest point of a sheared box is no farther than any other of its points")
{
    VDBOUNCE_RANDOM(random);
    for (int trial = 0; trial < 60; ++trial) {
        Mat3d matrix;
        do {
            for (int i = 0; i < 9; ++i) matrix(i / 3, i % 3) = random.uniform(-1, 1);
        } while (std::abs(matrix.determinant()) < 0.05);
        const LinearTransform transform(matrix, random.direction());
        const Box box{Vec3d(-3, -2, -1), Vec3d(4, 1, 2)};
        for (int i = 0; i < 40; ++i) {
            const Vec3d index = random.in(Box{Vec3d::Constant(-9), Vec3d::Constant(9)});
            const Vec3d closest = closestPointInBox(box, index, transform);
            REQUIRE((closest.array() >= box.min.array()).all());
            REQUIRE((closest.array() <= box.max.array()).all());
            const double distance = transform.vectorToWorld(closest - index).norm();
            for (int k = 0; k < 200; ++k) {
                // Points near the answer and anywhere in the box.
                Vec3d other = k % 2 == 0 ? random.in(box) : Vec3d(closest + 0.05 * random.direction());
                other = other.cwiseMax(box.min).cwiseMin(box.max);
                REQUIRE(transform.vectorToWorld(other - index).norm() >= distance - 1e-9);
            }
        }
    }
}

TEST_CASE("a transform carries points there and back, and gradients perpendicular to level sets")
{
    VDBOUNCE_RANDOM(random);
    Mat3d matrix;
    matrix << 0.1, 0.02, 0, -0.03, 0.2, 0.04, 0.01, 0, 0.15;
    const LinearTransform transform(matrix, Vec3d(3, -2, 1));
    CHECK_FALSE(transform.orthogonal());
    CHECK(
        LinearTransform(0.1 * Mat3d(Eigen::AngleAxisd(0.5, Vec3d(1, 2, 3).normalized())), Vec3d::Zero()).orthogonal());
    for (int i = 0; i < 1000; ++i) {
        const Vec3d index = random.in(Box{Vec3d::Constant(-50), Vec3d::Constant(50)});
        REQUIRE((transform.toIndex(transform.toWorld(index)) - index).norm() < 1e-10);
        const Vec3d gradient = random.direction();
        const Vec3d along = gradient.unitOrthogonal();
        REQUIRE(std::abs(transform.gradientToWorld(gradient).dot(transform.vectorToWorld(along))) < 1e-12);
    }
}
