// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/random.h"

#include "vdbounce/base/error.h"
#include "vdbounce/field/openvdb_transform.h"
#include "vdbounce/implicit/sample_field.h"
#include "vdbounce/implicit/shapes.h"
#include "vdbounce/io/openvdb_grid.h"

#include <Eigen/Geometry>
#include <openvdb/tools/Diagnostics.h>
#include <openvdb/tools/LevelSetMeasure.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/LevelSetTracker.h>

#include <tbb/global_control.h>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

// Compares every voxel of a cube with the field.
void requireSampled(const ImplicitField& field, const openvdb::FloatGrid& grid, const openvdb::CoordBBox& box,
                    float exterior, float interior)
{
    const LinearTransform transform = toLinearTransform(grid.transform());
    auto values = grid.getConstAccessor();
    for (auto it = box.begin(); it; ++it) {
        const openvdb::Coord ijk = *it;
        const float phi = float(field.phi(transform.toWorld(Vec3d(ijk.x(), ijk.y(), ijk.z())), 0.0));
        const bool active = phi < exterior && phi > -interior;
        const float expected = std::min(exterior, std::max(-interior, phi));
        INFO("at " << ijk.x() << " " << ijk.y() << " " << ijk.z() << ": " << values.getValue(ijk));
        // A row starts at its first voxel and goes on in steps, which rounds otherwise.
        REQUIRE(values.getValue(ijk) == Approx(expected).margin(1e-6 * exterior));
        if (std::abs(phi - exterior) > 1e-5 && std::abs(phi + interior) > 1e-5)
            REQUIRE(values.isValueOn(ijk) == active);
    }
}

const openvdb::CoordBBox kCube(openvdb::Coord(-40), openvdb::Coord(40));

} // namespace

TEST_CASE("every voxel of a sampled shape has its phi, and beyond the band its sign")
{
    const ShapeFormula shapes[] = {
        SphereShape{Vec3d(0.01, 0.02, 0.03), 0.8}, BoxShape{Vec3d(0.1, 0, 0), Vec3d(0.7, 0.2, 0.5)},
        TorusShape{Vec3d::Zero(), Vec3d(0.3, 1, 0.1), 0.6, 0.2},
        ConeShape{Vec3d(0, -0.6, 0), Vec3d(0, 0.8, 0), 0.5, 0.0}, EllipsoidShape{Vec3d::Zero(), Vec3d(0.9, 0.4, 0.6)}};
    for (const ShapeFormula& shape : shapes) {
        SampleFieldOptions options;
        options.voxelSize = 0.03;
        options.exteriorVx = 3.0;
        options.interiorVx = 4.5;
        const auto field = makeField(shape);
        const LevelSetGrid grid = sampleField(*field, options);
        INFO(nameOf(shape));
        requireSampled(*field, toOpenVdb(grid), kCube, 0.09f, 0.135f);
        CHECK(toOpenVdb(grid).background() == Approx(0.09));
    }
}

TEST_CASE("a shape is sampled on turned, sheared and uneven voxels too")
{
    Mat3d rows;
    rows << 0.03, 0.01, 0.0, -0.005, 0.04, 0.002, 0.0, 0.004, 0.02;
    SampleFieldOptions options;
    options.transform = LinearTransform(rows, Vec3d(0.3, -0.1, 0.2));
    const auto field = makeField(SphereShape{Vec3d(0.2, 0.1, 0), 0.5});
    const LevelSetGrid grid = sampleField(*field, options);
    const float band = float(3.0 * options.transform->voxelSize().maxCoeff());
    requireSampled(*field, toOpenVdb(grid), kCube, band, band);
}

TEST_CASE("OpenVDB takes a sampled sphere for a level set, and has the same voxels and measures")
{
    SampleFieldOptions options;
    options.voxelSize = 0.01;
    const auto field = makeField(SphereShape{Vec3d(0.1, 0.2, 0.3), 0.5});
    const LevelSetGrid handle = sampleField(*field, options);
    auto grid = toOpenVdb(handle).deepCopy();
    CHECK(openvdb::tools::checkLevelSet(*grid) == "");
    const auto theirs =
        openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(0.5f, openvdb::Vec3f(0.1f, 0.2f, 0.3f), 0.01f, 3.0f);
    // Theirs leaves out some voxels at the rim of the band.
    CHECK(std::abs(double(grid->activeVoxelCount()) / double(theirs->activeVoxelCount()) - 1.0) < 0.01);
    CHECK(openvdb::tools::levelSetVolume(*grid) == Approx(4.0 / 3.0 * M_PI * 0.125).epsilon(1e-3));
    CHECK(openvdb::tools::levelSetArea(*grid) == Approx(M_PI).epsilon(1e-3));
}

TEST_CASE("a sampled field is the same for any number of threads")
{
    SampleFieldOptions options;
    options.voxelSize = 0.01;
    const auto field = makeField(TorusShape{Vec3d(0.1, 0.2, 0.3), Vec3d(1, 2, 3), 0.5, 0.2});
    const auto sampledBy = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return sampleField(*field, options);
    };
    const LevelSetGrid one = sampledBy(1);
    const LevelSetGrid four = sampledBy(4);
    CHECK(toOpenVdb(one).tree().hasSameTopology(toOpenVdb(four).tree()));
    std::uint64_t different = 0;
    auto b = toOpenVdb(four).getConstAccessor();
    for (auto a = toOpenVdb(one).cbeginValueAll(); a; ++a)
        different += a.isVoxelValue() && *a != b.getValue(a.getCoord()) ? 1 : 0;
    CHECK(different == 0);
}

TEST_CASE("a plane is sampled within a box, filled below and cut off at its sides")
{
    SampleFieldOptions options;
    options.voxelSize = 0.05;
    const auto field = makeField(PlaneShape{Vec3d(0, 0.02, 0), Vec3d(0, 1, 0)});
    CHECK_THROWS_WITH(sampleField(*field, options), Catch::Contains("has no end"));
    options.within = Box{Vec3d(-1, -0.5, -1), Vec3d(1, 0.5, 1)};
    const LevelSetGrid handle = sampleField(*field, options);
    const openvdb::FloatGrid& grid = toOpenVdb(handle);
    auto values = grid.getConstAccessor();
    CHECK(values.getValue(openvdb::Coord(3, 0, -20)) == Approx(-0.02));
    CHECK(values.getValue(openvdb::Coord(3, -9, 5)) == Approx(-0.15));
    CHECK(values.getValue(openvdb::Coord(3, -11, 5)) == Approx(0.15)); // below the box
    CHECK(values.getValue(openvdb::Coord(21, 0, 0)) == Approx(0.15));  // and beside it
    CHECK(values.isValueOn(openvdb::Coord(20, 0, 20)));
    CHECK_FALSE(values.isValueOn(openvdb::Coord(21, 0, 20)));
    options.within = Box{Vec3d(1, 0, 0), Vec3d(-1, 1, 1)};
    CHECK_THROWS_AS(sampleField(*field, options), UsageError);
}

TEST_CASE("a shape that would take more memory than allowed is refused before it does")
{
    SampleFieldOptions options;
    options.voxelSize = 1e-4;
    options.maxMemory = 100'000'000;
    const auto field = makeField(SphereShape{Vec3d::Zero(), 100.0});
    CHECK_THROWS_WITH(sampleField(*field, options), Catch::Contains("more memory than is allowed"));
    options.voxelSize = 1.5e-5;
    CHECK_THROWS_AS(sampleField(*makeField(SphereShape{Vec3d(1e5, 0, 0), 1.0}), options), UsageError);
    options.voxelSize = 0.0;
    CHECK_THROWS_AS(sampleField(*field, options), UsageError);
    options.voxelSize = 1.0;
    options.exteriorVx = 0.5;
    CHECK_THROWS_AS(sampleField(*field, options), UsageError);
}
