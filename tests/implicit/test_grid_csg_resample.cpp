// SPDX-License-Identifier: Apache-2.0
#include "implicit/csg_grids.h"

#include "vdbounce/field/distance_field.h"

#include <tbb/global_control.h>

using namespace vdbounce;
using namespace vdbounce::test;
using openvdb::Coord;

namespace {

Mat3d turned() { return Eigen::AngleAxisd(0.7, Vec3d(1, 2, 3).normalized()).toRotationMatrix(); }

Vec3d worldOf(const LevelSetGrid& grid, const Coord& voxel)
{
    const openvdb::Vec3d world = toOpenVdb(grid).indexToWorld(voxel);
    return Vec3d(world.x(), world.y(), world.z());
}

// Checks every voxel of the result near the origin: in the band within `error` of phi, elsewhere its sign, and the
// band's width. What lies next to the band's end, within `margin`, has values beyond it mixed in.
void requireLike(const LevelSetGrid& grid, const Phi& phi, double error, double margin, int side)
{
    const double width = double(toOpenVdb(grid).background());
    auto in = toOpenVdb(grid).getConstAccessor();
    double worst = 0.0;
    std::size_t wrong = 0;
    forEachVoxelWithin(side, [&](const Coord& voxel) {
        const double value = double(in.getValue(voxel));
        const double truth = phi(worldOf(grid, voxel));
        if (std::abs(truth) < width - margin) {
            if (!in.isValueOn(voxel)) ++wrong;
            worst = std::max(worst, std::abs(value - truth));
        } else if (std::abs(truth) > width + margin) {
            if (in.isValueOn(voxel) || std::abs(value) != width || (value < 0.0) != (truth < 0.0)) ++wrong;
        }
    });
    CHECK(wrong == 0);
    CHECK(worst < error);
}

} // namespace

TEST_CASE("a grid of other voxels is resampled onto the finer ones, with a note and its inside")
{
    const Vec3d centre(3.0, 1.0, -2.0);
    // A ball of 24 coarse voxels, whose inside is tiles, and a small one of fine voxels within.
    const LevelSetGrid coarse = bandLevelSet(sphere(12.0), 30, 3.0, uniformTransform(0.5));
    const LevelSetGrid fine = bandLevelSet(sphere(3.0, centre), 40, 8.0, uniformTransform(0.2));
    const Phi both = [&](const Vec3d& p) { return std::max(p.norm() - 12.0, 3.0 - (p - centre).norm()); };
    for (bool coarseFirst : {true, false}) {
        GridCsg result;
        if (coarseFirst) {
            result = csg(CsgOperation::Subtraction, coarse, fine);
            requireLike(result.grid, both, 0.01, 0.87, 72);
        } else {
            result = csg(CsgOperation::Union, fine, coarse);
            requireLike(result.grid, sphere(12.0), 0.01, 0.87, 72);
        }
        CHECK(toOpenVdb(result.grid).transform() == toOpenVdb(fine).transform());
        REQUIRE(!result.notes.empty());
        CHECK_THAT(result.notes[0], Catch::StartsWith("resampled: ") && Catch::Contains("voxels of 0.5") &&
                                        Catch::Contains("onto") && Catch::EndsWith("(voxels of 0.2)"));
    }
    GridCsgOptions options;
    options.voxels = CsgVoxels::First;
    const LevelSetGrid onCoarse = made(CsgOperation::Subtraction, coarse, fine, options);
    CHECK(toOpenVdb(onCoarse).transform() == toOpenVdb(coarse).transform());
    requireLike(onCoarse, both, 0.01, 0.35, 32);
}

TEST_CASE("rotated, sheared and long voxels are resampled")
{
    Mat3d shear = Mat3d::Identity() * 0.5;
    shear(1, 0) = 0.2;
    const Mat3d frames[] = {0.5 * turned(), shear, Vec3d(0.5, 0.7, 0.4).asDiagonal(), -0.5 * Mat3d::Identity()};
    const Mat3d onto = 0.4 * turned().transpose();
    for (const Mat3d& frame : frames) {
        const auto at = [](const Mat3d& rows, const Vec3d& origin) { return affineTransform(rows, origin); };
        const LevelSetGrid a = bandLevelSet(sphere(4.0), 18, 3.0, at(onto, Vec3d(0.1, 0.2, 0.3)));
        const LevelSetGrid b = bandLevelSet(sphere(4.0, Vec3d(1, 0, 0)), 36, 3.0, at(frame, Vec3d(0.3, 0.0, -0.2)));
        GridCsgOptions options;
        options.voxels = CsgVoxels::First;
        const LevelSetGrid result = made(CsgOperation::Union, a, b, options);
        const Phi phi = [](const Vec3d& p) { return std::min(p.norm() - 4.0, (p - Vec3d(1, 0, 0)).norm() - 4.0); };
        requireLike(result, phi, 0.03, 0.95, 22);
    }
}

TEST_CASE("voxels that lie a whole number apart are taken over as they are")
{
    const LevelSetGrid a = bandLevelSet(sphere(6.0), 12);
    const auto shifted = affineTransform(Mat3d::Identity(), Vec3d(5.0, -3.0, 2.0));
    const LevelSetGrid b = bandLevelSet(sphere(6.0), 16, 3.0, shifted);
    const GridCsg result = csg(CsgOperation::Union, a, b);
    CHECK(result.notes.size() == 1);
    double worst = 0.0;
    forEachVoxelWithin(14, [&](const Coord& voxel) {
        // At the end of the band the operand was widened by its redistanced values.
        if (std::abs(valueAt(a, voxel)) > 2.9f) return;
        worst = std::max(worst, std::abs(double(valueAt(result.grid, voxel) - valueAt(a, voxel))));
    });
    CHECK(worst < 1e-5);
}

TEST_CASE("transforms that differ by rounding are the same")
{
    const LevelSetGrid a = bandLevelSet(sphere(6.0), 12);
    const LevelSetGrid b = bandLevelSet(sphere(6.0), 12, 3.0, affineTransform(Mat3d::Identity(), Vec3d(1e-7, 0, 0)));
    CHECK(csg(CsgOperation::Union, a, b).notes.empty());
}

TEST_CASE("a surface that its grid's box cuts off ends there after resampling, too")
{
    const LevelSetGrid plate = bandLevelSet(halfSpace(Vec3d(0, 1, 0)), 16, 3.0, uniformTransform(0.5));
    const LevelSetGrid ball = bandLevelSet(sphere(1.0), 20, 3.0, uniformTransform(0.2));
    const LevelSetGrid result = made(CsgOperation::Union, ball, plate);
    auto in = toOpenVdb(result).getConstAccessor();
    std::size_t wrong = 0;
    forEachVoxelWithin(60, [&](const Coord& voxel) {
        const Vec3d world = worldOf(result, voxel);
        const Coord near(int(std::round(world.x() / 0.5)), int(std::round(world.y() / 0.5)),
                         int(std::round(world.z() / 0.5)));
        const double inPlate = double(toOpenVdb(plate).tree().getValue(near));
        if (std::abs(world.y()) < 0.3 || std::abs(world.norm() - 1.0) < 0.3) return;
        if ((in.getValue(voxel) < 0.0f) != (inPlate < 0.0 || world.norm() < 1.0)) ++wrong;
        // No voxel of the band beyond those of the plate's.
        if (in.isValueOn(voxel) && world.cwiseAbs().maxCoeff() > 8.01) ++wrong;
    });
    CHECK(wrong == 0);
}

TEST_CASE("resampling gives the same for any number of threads")
{
    const LevelSetGrid a = bandLevelSet(sphere(5.0), 40, 3.0, affineTransform(0.2 * turned(), Vec3d::Zero()));
    const LevelSetGrid b = bandLevelSet(sphere(5.0, Vec3d(2, 0, 0)), 30, 3.0, uniformTransform(0.3));
    const LevelSetGrid many = made(CsgOperation::Intersection, a, b);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    CHECK(differences(many, made(CsgOperation::Intersection, a, b), 45) == 0);
}
