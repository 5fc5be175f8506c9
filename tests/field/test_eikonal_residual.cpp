// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/random.h"

#include "vdbounce/field/eikonal_residual.h"

#include <Eigen/Geometry>

#include <cmath>

#include <tbb/global_control.h>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

constexpr double kVoxel = 0.05;

EikonalResidual residualOf(const openvdb::FloatGrid::Ptr& grid)
{
    return eikonalResidual(DistanceField(levelSet(grid)));
}

EikonalResidual residualOf(const Phi& phi, int side = 24)
{
    return residualOf(bandGrid(phi, uniformTransform(kVoxel), side));
}

// Every value becomes change(value), the background too.
openvdb::FloatGrid::Ptr changed(const openvdb::FloatGrid::Ptr& grid, const std::function<float(float)>& change)
{
    auto result = grid->deepCopy();
    for (auto it = result->beginValueAll(); it; ++it) it.setValue(change(*it));
    result->tree().root().setBackground(change(grid->background()), /*updateChildNodes=*/false);
    return result;
}

Phi cube(double reach)
{
    return [=](const Vec3d& p) {
        const Vec3d d = p.cwiseAbs() - Vec3d::Constant(reach);
        return d.cwiseMax(0.0).norm() + std::min(0.0, d.maxCoeff());
    };
}

// A turned, sheared, mirrored one, with three sides.
openvdb::math::Transform::Ptr skewTransform(Random& random)
{
    const Mat3d turn = Eigen::Quaterniond::FromTwoVectors(Vec3d::UnitX(), random.direction()).toRotationMatrix();
    Mat3d shear = Mat3d::Identity();
    shear(0, 1) = random.uniform(-0.5, 0.5);
    shear(1, 2) = random.uniform(-0.5, 0.5);
    const Vec3d sides(random.uniform(0.5, 2.0), random.uniform(0.5, 2.0), -random.uniform(0.5, 2.0));
    return affineTransform(kVoxel * sides.asDiagonal() * shear * turn, random.direction());
}

} // namespace

TEST_CASE("a plane's residual is rounding, whatever the direction and the transform")
{
    VDBOUNCE_RANDOM(random);
    for (int i = 0; i < 10; ++i) {
        const Phi plane = halfSpace(random.direction(), random.uniform(-0.1, 0.1));
        const EikonalResidual flat = residualOf(denseGrid(plane, uniformTransform(kVoxel), 8));
        CHECK(flat.voxels == 15 * 15 * 15); // all but the outermost
        CHECK(flat.largest < 1e-5);
        CHECK(flat.median < 1e-5);
        CHECK(flat.slope == Approx(1.0).epsilon(1e-6));
        const EikonalResidual skew = residualOf(denseGrid(plane, skewTransform(random), 8));
        CHECK(skew.voxels == 15 * 15 * 15);
        CHECK(skew.largest < 2e-5);
        CHECK(skew.creaseVoxels == 0);
    }
}

TEST_CASE("a sphere's residual is that of central differences, and falls with the square of the voxel")
{
    // Around a ball the central difference along an axis that meets the normal at a cosine c falls short of it by
    // c (1 - c^2) / 2 r^2, so |grad phi| by (1 - sum c^4) / 2 r^2: a third of 1 / r^2 at most, a fifth on average.
    for (const double radiusVx : {8.0, 16.0}) {
        const Vec3d centre(0.013, 0.007, -0.011);
        const EikonalResidual ball = residualOf(sphere(radiusVx * kVoxel, centre), 22);
        const double tightest = radiusVx - 2.4; // of the voxels whose neighbours are in the band
        CHECK(ball.voxels > 1000);
        CHECK(ball.largest < 1.1 / 3.0 / (tightest * tightest));
        CHECK(ball.largest > 0.9 / 3.0 / (tightest * tightest));
        CHECK(ball.mean == Approx(0.2 / (radiusVx * radiusVx)).epsilon(0.1));
        CHECK(ball.median == Approx(0.2 / (radiusVx * radiusVx)).epsilon(0.25));
        CHECK(ball.offVoxels == 0);
        CHECK((ball.where - centre).norm() / kVoxel == Approx(tightest).margin(0.5));
    }
}

TEST_CASE("values that are multiples of a distance show by how much")
{
    const auto ball = bandGrid(sphere(0.7), uniformTransform(kVoxel), 22);
    for (const float factor : {0.5f, 2.0f}) {
        const EikonalResidual scaled = residualOf(changed(ball, [=](float v) { return factor * v; }));
        CHECK(scaled.voxels > 10000);
        CHECK(scaled.slope == Approx(factor).epsilon(2e-3));
        CHECK(scaled.mean == Approx(std::abs(factor - 1.0)).epsilon(5e-3));
        CHECK(scaled.median == Approx(scaled.mean).epsilon(0.07));
        CHECK(scaled.offShare() == 1.0);
    }
}

TEST_CASE("a distorted distance shows the slope that it has")
{
    // phi + 4 phi^3 of a plane, whose slope is 1 + 12 phi^2 and by central differences 4 voxel^2 more.
    const auto plane = denseGrid(halfSpace(Vec3d::UnitX(), 0.01), uniformTransform(kVoxel), 8);
    const EikonalResidual distorted = residualOf(changed(plane, [](float v) { return v + 4.0f * v * v * v; }));
    double sum = 0.0;
    for (int x = -7; x <= 7; ++x) {
        const double phi = x * kVoxel - 0.01;
        sum += 12.0 * phi * phi + 4.0 * kVoxel * kVoxel;
    }
    CHECK(distorted.mean == Approx(sum / 15).epsilon(1e-4));
    CHECK(distorted.largest == Approx(12.0 * 0.36 * 0.36 + 4.0 * kVoxel * kVoxel).epsilon(1e-4));
    CHECK(distorted.where.x() == Approx(-0.35));
}

TEST_CASE("creases of a true distance are no fault")
{
    VDBOUNCE_RANDOM(random);
    const auto measured = [&](const Phi& phi) { return residualOf(phi); };
    for (int i = 0; i < 6; ++i) {
        const double reach = random.uniform(0.3, 0.7);
        const Mat3d turn = Eigen::Quaterniond::FromTwoVectors(Vec3d::UnitX(), random.direction()).toRotationMatrix();
        const EikonalResidual box = measured([&](const Vec3d& p) { return cube(reach)(i < 2 ? p : Vec3d(turn * p)); });
        INFO("reach " << reach << ", case " << i);
        CHECK(box.creaseVoxels > 100);
        CHECK(box.median < 0.01);
        CHECK(box.offShare() < 0.04);
        CHECK(box.mean < 0.015);
        // Two bodies: the crease lies half way between them.
        const Vec3d apart = 0.5 * random.direction();
        const EikonalResidual two =
            measured([&](const Vec3d& p) { return std::min((p - apart).norm() - 0.43, (p + apart).norm() - 0.43); });
        CHECK(two.creaseVoxels > 20);
        CHECK(two.largest < 0.15);
    }
    // Where the values are not distances creases do not hide it.
    const EikonalResidual twice =
        residualOf(changed(bandGrid(cube(0.3), uniformTransform(kVoxel), 20), [](float v) { return 2.0f * v; }));
    CHECK(twice.offShare() > 0.98);
}

TEST_CASE("a voxel that is off is found where it is")
{
    VDBOUNCE_RANDOM(random);
    for (int i = 0; i < 10; ++i) {
        auto grid = denseGrid(halfSpace(Vec3d::UnitZ(), 0.01), uniformTransform(kVoxel), 12);
        const openvdb::Coord voxel(int(random.uniform(-9, 9)), int(random.uniform(-9, 9)), int(random.uniform(-9, 9)));
        grid->getAccessor().setValueOn(voxel, grid->getAccessor().getValue(voxel) + float(0.5 * kVoxel));
        const EikonalResidual found = residualOf(grid);
        // Its neighbours above and below have central differences off by a quarter, of 1 or of 0 beside it.
        CHECK(found.largest > 0.1);
        CHECK(found.largest < 0.51);
        CHECK((found.where / kVoxel - Vec3d(voxel.x(), voxel.y(), voxel.z())).norm() < 1.01);
        CHECK(found.offVoxels <= 7);
    }
}

TEST_CASE("clamped values are not measured")
{
    const Phi plane = halfSpace(Vec3d::UnitY(), 0.4 * kVoxel);
    CHECK(residualOf(bandGrid(plane, uniformTransform(kVoxel), 8, 0.9)).voxels == 0);
    const EikonalResidual thin = residualOf(bandGrid(plane, uniformTransform(kVoxel), 8, 2.0));
    CHECK(thin.voxels == 15 * 15 * 2);
    CHECK(thin.largest < 1e-5);
    // Of an interior that is narrower, too.
    const auto grid = changed(bandGrid(plane, uniformTransform(kVoxel), 8, 4.0),
                              [](float v) { return std::max(v, float(-2.0 * kVoxel)); });
    CHECK(residualOf(grid).largest < 1e-5);
}

TEST_CASE("the residual has the same bits for any number of threads")
{
    const auto grid = bandGrid(cube(0.8), uniformTransform(0.02), 48);
    const DistanceField field(levelSet(grid));
    const EikonalResidual many = eikonalResidual(field);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const EikonalResidual single = eikonalResidual(field);
    CHECK(single.mean == many.mean);
    CHECK(single.slope == many.slope);
    CHECK(single.largest == many.largest);
    CHECK(single.where == many.where);
    CHECK(single.median == many.median);
}
