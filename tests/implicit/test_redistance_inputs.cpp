// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"

#include "vdbounce/base/error.h"
#include "vdbounce/implicit/redistance.h"
#include "vdbounce/io/openvdb_grid.h"

#include <catch2/catch.hpp>
#include <openvdb/tools/Clip.h>
#include <openvdb/tools/LevelSetUtil.h>

#include <cmath>
#include <limits>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

constexpr double kVoxel = 1.0 / 16;
const Vec3d kCentre(0.013, 0.0171, 0.0093); // off the lattice

ScalarGrid scalar(const openvdb::FloatGrid::Ptr& grid) { return toScalarGrid(openvdb::FloatGrid::ConstPtr(grid)); }

Phi box(const Vec3d& half)
{
    return [half](const Vec3d& p) {
        const Vec3d q = p.cwiseAbs() - half;
        return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
    };
}

double phiAt(const Phi& phi, const openvdb::FloatGrid& grid, const openvdb::Coord& c)
{
    const openvdb::Vec3d p = grid.indexToWorld(c);
    return phi(Vec3d(p.x(), p.y(), p.z()));
}

double largestErrorVx(const openvdb::FloatGrid& grid, const Phi& phi)
{
    double largest = 0.0;
    for (auto it = grid.cbeginValueOn(); it; ++it)
        largest = std::max(largest, std::abs(*it - phiAt(phi, grid, it.getCoord())) / kVoxel);
    return largest;
}

} // namespace

TEST_CASE("sharp edges stay where they are when redistanced")
{
    const Phi phi = box(Vec3d(0.61, 0.52, 0.43));
    // The function that CSG makes, max of planes, is no distance beside edges.
    const Phi planes = [](const Vec3d& p) { return (p.cwiseAbs() - Vec3d(0.61, 0.52, 0.43)).maxCoeff(); };
    const openvdb::FloatGrid::Ptr grid = bandGrid(planes, uniformTransform(kVoxel), 16);
    const LevelSetGrid handle = redistance(scalar(grid));
    const openvdb::FloatGrid& result = toOpenVdb(handle);
    double largest = 0.0;
    double away = 0.0; // of voxels with their closest point not within two voxels of an edge
    for (auto it = result.cbeginValueOn(); it; ++it) {
        const openvdb::Vec3d w = result.indexToWorld(it.getCoord());
        const Vec3d p = Vec3d(w.x(), w.y(), w.z()).cwiseAbs();
        const double error = std::abs(*it - phiAt(phi, result, it.getCoord())) / kVoxel;
        largest = std::max(largest, error);
        Vec3d depth = Vec3d(0.61, 0.52, 0.43) - p;
        std::sort(depth.data(), depth.data() + 3);
        if (depth[1] > std::abs(depth[0]) + 2.0 * kVoxel) away = std::max(away, error);
    }
    CHECK(largest < 0.5); // edges are cut within their cells: the grid does not know more
    CHECK(away < 1e-3);
    for (auto it = grid->cbeginValueOn(); it; ++it) {
        REQUIRE(((*it < 0.0f) == (result.tree().getValue(it.getCoord()) < 0.0f)));
    }
}

TEST_CASE("a fog volume becomes the level set of one of its values")
{
    openvdb::FloatGrid::Ptr fog = bandGrid(sphere(1.0, kCentre), uniformTransform(kVoxel), 24);
    openvdb::tools::sdfToFogVolume(*fog);
    RedistanceOptions options;
    options.iso = 0.5; // at half the band's width inside
    options.inside = Inside::Above;
    const LevelSetGrid handle = redistance(scalar(fog), options);
    CHECK(largestErrorVx(toOpenVdb(handle), sphere(1.0 - 1.5 * kVoxel, kCentre)) <
          0.1); // a ramp with bends at both ends
    CHECK(toOpenVdb(handle).background() == Approx(3.0 * kVoxel));
    CHECK(toOpenVdb(handle).tree().getValue(openvdb::Coord(0, 0, 0)) == Approx(-3.0 * kVoxel));
}

TEST_CASE("tiles that meet have a surface between them")
{
    openvdb::initialize();
    const auto grid = openvdb::FloatGrid::create(0.0f);
    grid->tree().addTile(1, openvdb::Coord(0, 0, 0), 1.0f, true);
    RedistanceOptions options;
    options.iso = 0.5;
    options.inside = Inside::Above;
    const LevelSetGrid handle = redistance(scalar(grid), options);
    const openvdb::FloatTree& tree = toOpenVdb(handle).tree();
    CHECK(tree.getValue(openvdb::Coord(-1, 3, 4)) == Approx(0.5));
    CHECK(tree.getValue(openvdb::Coord(-3, 3, 4)) == Approx(2.5));
    CHECK(tree.getValue(openvdb::Coord(7, 3, 4)) == Approx(-0.5));
    CHECK(tree.getValue(openvdb::Coord(5, 3, 4)) == Approx(-2.5));
    CHECK(tree.getValue(openvdb::Coord(-5, 3, 4)) == Approx(3.0));
}

TEST_CASE("values need only be known near the surface, and no tile need tell the inside")
{
    openvdb::initialize();
    const auto grid = openvdb::FloatGrid::create(7.0f); // which is neither a distance nor a sign
    grid->setTransform(uniformTransform(kVoxel));
    for (int x = -24; x <= 24; ++x) {
        for (int y = -24; y <= 24; ++y) {
            for (int z = -24; z <= 24; ++z) {
                const Vec3d p = kVoxel * Vec3d(x, y, z) - kCentre;
                if (std::abs(p.norm() - 1.0) < 2.0 * kVoxel)
                    grid->tree().setValueOn(openvdb::Coord(x, y, z), float(p.squaredNorm() - 1.0));
            }
        }
    }
    RedistanceOptions options;
    options.exterior = Length{4.0, true};
    options.interior = Length{5.0, true};
    const LevelSetGrid handle = redistance(scalar(grid), options);
    const openvdb::FloatGrid& result = toOpenVdb(handle);
    CHECK(largestErrorVx(result, sphere(1.0, kCentre)) < 5e-3);
    for (int x = 0; x <= 32; ++x) {
        const double exact = phiAt(sphere(1.0, kCentre), result, openvdb::Coord(x, 0, 0));
        const double cut = std::min(std::max(exact, -5.0 * kVoxel), 4.0 * kVoxel);
        CHECK(result.tree().getValue(openvdb::Coord(x, 0, 0)) == Approx(cut).margin(1e-3));
    }
}

TEST_CASE("where a level set is cut off no surface is made up")
{
    const openvdb::FloatGrid::Ptr whole = bandGrid(sphere(1.0, kCentre), uniformTransform(kVoxel), 24);
    const openvdb::FloatGrid::Ptr part = openvdb::tools::clip(*whole, openvdb::BBoxd({-2, -2, -2}, {0.2, 2, 2}));
    RedistanceOptions options;
    options.exterior = options.interior = Length{5.0, true};
    const LevelSetGrid handle = redistance(scalar(part), options);
    const openvdb::FloatGrid& result = toOpenVdb(handle);
    CHECK(largestErrorVx(result, sphere(1.0, kCentre)) < 0.02);
    std::size_t active = 0;
    int farthest = -100;
    for (auto it = result.cbeginValueOn(); it; ++it) {
        ++active;
        farthest = std::max(farthest, it.getCoord().x());
    }
    CHECK(active > 10000);
    CHECK(farthest <= 6); // the last layer has x = 3; ways to the rim lean out a little
}

TEST_CASE("redistancing refuses what has no surface, naming why")
{
    const openvdb::FloatGrid::Ptr grid = bandGrid(sphere(1.0), uniformTransform(kVoxel), 24);
    RedistanceOptions options;
    options.iso = 5.0;
    CHECK_THROWS_AS(redistance(scalar(grid), options), InputError);
    CHECK_THROWS_WITH(redistance(scalar(grid), options), Catch::Contains("never takes the value 5"));
    CHECK_THROWS_WITH(redistance(scalar(openvdb::FloatGrid::create(1.0f))), Catch::Contains("no active voxels"));

    const openvdb::FloatGrid::Ptr broken = grid->deepCopy();
    broken->tree().setValueOn(openvdb::Coord(3, 16, 2), std::numeric_limits<float>::quiet_NaN());
    CHECK_THROWS_WITH(redistance(scalar(broken)), Catch::Contains("nan at voxel 3,16,2"));
    broken->tree().setValueOn(openvdb::Coord(3, 16, 2), std::numeric_limits<float>::infinity());
    CHECK_THROWS_WITH(redistance(scalar(broken)), Catch::Contains("inf at voxel 3,16,2"));

    options.iso = 0.0;
    options.exterior = Length{0.5, true};
    CHECK_THROWS_AS(redistance(scalar(grid), options), UsageError);
}
