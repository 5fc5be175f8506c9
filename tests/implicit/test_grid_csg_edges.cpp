// SPDX-License-Identifier: Apache-2.0
#include "implicit/csg_grids.h"

#include "vdbounce/base/error.h"
#include "vdbounce/field/distance_field.h"

using namespace vdbounce;
using namespace vdbounce::test;
using openvdb::Coord;

namespace {

// Where faces lie: on no voxel.
constexpr double kOffset = 0.033;

// Of voxels of 0.1: all below kOffset along the normal, ended by a ball so that it is closed.
LevelSetGrid slab(const Vec3d& normal, double halfWidthVx)
{
    const Phi phi = [=](const Vec3d& p) { return std::max(normal.dot(p) - kOffset, p.norm() - 1.5); };
    return bandLevelSet(phi, 22, halfWidthVx, uniformTransform(0.1));
}

// The distance to the corner that both slabs have in common.
double toCorner(double atX, double atY)
{
    const double x = atX - kOffset;
    const double y = atY - kOffset;
    return std::hypot(std::max(x, 0.0), std::max(y, 0.0)) + std::min(0.0, std::max(x, y));
}

GridCsgOptions blended(double radius)
{
    GridCsgOptions options;
    options.blend = Length{radius, false};
    return options;
}

} // namespace

TEST_CASE("beside an edge minimum and maximum are never more than the distance, and redistance restores it")
{
    const LevelSetGrid x = slab(Vec3d(1, 0, 0), 4.0);
    const LevelSetGrid y = slab(Vec3d(0, 1, 0), 4.0);
    GridCsgOptions options;
    const LevelSetGrid sharp = made(CsgOperation::Intersection, x, y, options);
    options.redistance = true;
    const LevelSetGrid round = made(CsgOperation::Intersection, x, y, options);
    double worstSharp = 0.0;
    double worstRound = 0.0;
    for (auto voxel = toOpenVdb(round).cbeginValueOn(); voxel; ++voxel) {
        const openvdb::Vec3d at = toOpenVdb(round).indexToWorld(voxel.getCoord());
        if (std::abs(at.z()) > 0.3 || std::hypot(at.x(), at.y()) > 0.8) continue;
        const double truth = toCorner(at.x(), at.y());
        if (std::abs(truth) > 0.3) continue;
        const double plain = double(valueAt(sharp, voxel.getCoord()));
        CHECK(std::abs(plain) < std::abs(truth) + 1e-6);
        worstSharp = std::max(worstSharp, std::abs(plain - truth));
        worstRound = std::max(worstRound, std::abs(double(*voxel) - truth));
    }
    CHECK(worstSharp > 0.05); // outside of the edge up to (1 - 1/sqrt 2) of the distance
    CHECK(worstRound < 0.02);
}

TEST_CASE("a blend rounds the edge by a quarter of it, and nothing further away")
{
    const double blend = 0.4;
    const LevelSetGrid x = slab(Vec3d(1, 0, 0), 5.0);
    const LevelSetGrid y = slab(Vec3d(0, 1, 0), 5.0);
    for (CsgOperation operation : {CsgOperation::Union, CsgOperation::Intersection, CsgOperation::Subtraction}) {
        const LevelSetGrid grid = made(operation, x, y, blended(blend));
        const DistanceField field(grid);
        VDBOUNCE_RANDOM(random);
        for (int i = 0; i < 2000; ++i) {
            const Vec3d p(random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7), random.uniform(-0.2, 0.2));
            const double expected = combine(operation, p.x() - kOffset, p.y() - kOffset, blend);
            if (std::abs(expected) > 0.25) continue;
            // Trilinear lookup of a parabola of curvature 1 / blend.
            CHECK(field.phi(p) == Approx(expected).margin(0.1 * 0.1 / (4.0 * blend) + 1e-6));
        }
    }
}

TEST_CASE("blended grids have the band of their operands, which are widened where it takes that")
{
    const LevelSetGrid x = slab(Vec3d(1, 0, 0), 3.0);
    const LevelSetGrid y = slab(Vec3d(0, 1, 0), 3.0);
    const LevelSetGrid wide =
        made(CsgOperation::Union, slab(Vec3d(1, 0, 0), 5.0), slab(Vec3d(0, 1, 0), 5.0), blended(0.4));
    const GridCsg narrow = csg(CsgOperation::Union, x, y, blended(0.4));
    CHECK(toOpenVdb(narrow.grid).background() == toOpenVdb(x).background());
    double worst = 0.0;
    for (auto voxel = toOpenVdb(narrow.grid).cbeginValueOn(); voxel; ++voxel) {
        const openvdb::Vec3d at = toOpenVdb(narrow.grid).indexToWorld(voxel.getCoord());
        if (at.length() > 0.8) continue;
        worst = std::max(worst, std::abs(double(*voxel) - double(valueAt(wide, voxel.getCoord()))));
    }
    CHECK(worst < 0.02);
}

TEST_CASE("of flush faces subtraction leaves a sheet without inside, which redistance takes away")
{
    const LevelSetGrid a = bandLevelSet(turnedBox(Vec3d(8, 8, 8), Mat3d::Identity(), Vec3d(0, 0.3, 0)), 16);
    // From the middle up to the same face.
    const LevelSetGrid b = bandLevelSet(turnedBox(Vec3d(4, 4, 4), Mat3d::Identity(), Vec3d(0, 4.3, 0)), 16);
    const LevelSetGrid sheet = made(CsgOperation::Subtraction, a, b);
    const DistanceField field(sheet);
    CHECK(field.phi(Vec3d(0, 8.3, 0)) < 0.8);
    CHECK(field.phi(Vec3d(0, 8.3, 0)) >= 0.0);
    GridCsgOptions options;
    options.redistance = true;
    const DistanceField gone(made(CsgOperation::Subtraction, a, b, options));
    CHECK(gone.phi(Vec3d(0, 8.3, 0)) == Approx(3.0));
}

TEST_CASE("of a without a a sheet is left, with a note that there is no inside")
{
    const LevelSetGrid a = bandLevelSet(turnedBox(Vec3d(8, 6, 20), Mat3d::Identity(), Vec3d(0, 0.3, 0)), 24);
    const GridCsg sheet = csg(CsgOperation::Subtraction, a, a);
    CHECK(toOpenVdb(sheet.grid).activeVoxelCount() == toOpenVdb(a).activeVoxelCount());
    REQUIRE(sheet.notes.size() == 1);
    CHECK_THAT(sheet.notes[0], Catch::StartsWith("the result has no inside, only "));
    // Solids a voxel apart have nothing in common, but both bands there.
    const LevelSetGrid beside = bandLevelSet(turnedBox(Vec3d(3, 3, 3), Mat3d::Identity(), Vec3d(12, 0, 0)), 24);
    CHECK(csg(CsgOperation::Intersection, a, beside).notes == sheet.notes);
    // Less one that is shorter only an end of it is left inside, the rest of it being a sheet.
    const LevelSetGrid nearly = bandLevelSet(turnedBox(Vec3d(8, 6, 19), Mat3d::Identity(), Vec3d(0, 0.3, -1)), 24);
    CHECK(csg(CsgOperation::Subtraction, a, nearly).notes.empty());
    CHECK(csg(CsgOperation::Union, a, beside).notes.empty());

    GridCsgOptions options;
    options.redistance = true;
    const GridCsg gone = csg(CsgOperation::Subtraction, a, a, options);
    CHECK(toOpenVdb(gone.grid).activeVoxelCount() == 0);
    CHECK(gone.notes == std::vector<std::string>{"the result is empty"});
}
