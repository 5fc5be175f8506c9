// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/random.h"

#include "vdbounce/field/thin_features.h"

#include <Eigen/Geometry>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

constexpr double kVoxel = 0.05;

ThinFeatures featuresOf(const Phi& phi)
{
    return thinFeatures(levelSet(bandGrid(phi, uniformTransform(kVoxel), 24, 4.0)));
}

// A plate in any direction, and what is left of space without it.
Phi plate(const Vec3d& normal, double offset, double thicknessVx, double sign)
{
    return [=](const Vec3d& p) {
        const double slab = std::abs(normal.dot(p) - offset) - 0.5 * thicknessVx * kVoxel;
        return sign * std::max(slab, p.norm() - 0.8);
    };
}

} // namespace

TEST_CASE("walls and gaps about as thin as a voxel are found, in any direction, and thick ones are not")
{
    VDBOUNCE_RANDOM(random);
    for (int i = 0; i < 30; ++i) {
        const Vec3d normal = i < 3 ? Vec3d(Vec3d::Unit(i)) : random.direction();
        const double offset = random.uniform(-0.1, 0.1);
        INFO("normal " << normal.transpose() << ", offset " << offset);
        const ThinFeatures wall = featuresOf(plate(normal, offset, 0.9, 1.0));
        CHECK(wall.walls.voxels > 100);
        CHECK(std::abs(normal.dot(wall.walls.place) - offset) < kVoxel);
        CHECK(wall.walls.thinnest < 1.0 * kVoxel);
        const ThinFeatures gap = featuresOf(plate(normal, offset, 0.9, -1.0));
        CHECK(gap.gaps.voxels > 100);
        CHECK(featuresOf(plate(normal, offset, 6.0, 1.0)).walls.voxels == 0);
        CHECK(featuresOf(plate(normal, offset, 6.0, -1.0)).gaps.voxels == 0);
    }
}

TEST_CASE("smooth shapes and right angles have nothing thin")
{
    const ThinFeatures ball = featuresOf(sphere(0.7, Vec3d(0.01, 0.02, 0.03)));
    CHECK(ball.walls.voxels == 0);
    CHECK(ball.gaps.voxels == 0);
    const Phi box = [](const Vec3d& p) {
        const Vec3d d = p.cwiseAbs() - Vec3d(0.51, 0.63, 0.42);
        return d.cwiseMax(0.0).norm() + std::min(0.0, d.maxCoeff());
    };
    CHECK(featuresOf(box).walls.voxels == 0);
    CHECK(featuresOf([&](const Vec3d& p) { return -box(p); }).gaps.voxels == 0);
}

TEST_CASE("how thick thin walls and gaps are is told exactly, whether or not a voxel lies in them")
{
    VDBOUNCE_RANDOM(random);
    for (int i = 0; i < 30; ++i) {
        const Vec3d normal = i < 3 ? Vec3d(Vec3d::Unit(i)) : random.direction();
        // Half way between two layers of voxels where it lies along them.
        const double offset = i < 3 ? 0.5 * kVoxel : random.uniform(-0.1, 0.1);
        for (double thicknessVx : {0.1, 0.3, 0.9}) {
            const Phi slab = [&](const Vec3d& p) {
                return std::abs(normal.dot(p) - offset) - 0.5 * thicknessVx * kVoxel;
            };
            INFO("normal " << normal.transpose() << ", offset " << offset << ", thickness " << thicknessVx);
            CHECK(featuresOf(slab).walls.thinnest == Approx(thicknessVx * kVoxel).epsilon(1e-3));
            CHECK(featuresOf([&](const Vec3d& p) { return -slab(p); }).gaps.thinnest ==
                  Approx(thicknessVx * kVoxel).epsilon(1e-3));
        }
    }
}

TEST_CASE("the smallest feature is told up to twice the band, of balls its diameter")
{
    VDBOUNCE_RANDOM(random);
    for (int i = 0; i < 10; ++i) {
        const Vec3d normal = i < 3 ? Vec3d(Vec3d::Unit(i)) : random.direction();
        const double offset = random.uniform(-0.1, 0.1);
        const double thicknessVx = random.uniform(1.5, 6.0);
        const Phi slab = [&](const Vec3d& p) { return std::abs(normal.dot(p) - offset) - 0.5 * thicknessVx * kVoxel; };
        INFO("normal " << normal.transpose() << ", offset " << offset << ", thickness " << thicknessVx);
        const ThinFeatures::Smallest wall = featuresOf(slab).smallest;
        CHECK(wall.wall);
        CHECK(wall.thickness == Approx(thicknessVx * kVoxel).epsilon(1e-3));
        CHECK(std::abs(normal.dot(wall.place) - offset) < kVoxel);
        const ThinFeatures::Smallest gap = featuresOf([&](const Vec3d& p) { return -slab(p); }).smallest;
        CHECK_FALSE(gap.wall);
        CHECK(gap.thickness == Approx(thicknessVx * kVoxel).epsilon(1e-3));
        // Far from its middle, at the band's ends, a ball shows nothing.
        const Vec3d centre = 0.02 * random.direction();
        CHECK(featuresOf(sphere(0.6, centre)).smallest.thickness == 0.0);
    }
}
