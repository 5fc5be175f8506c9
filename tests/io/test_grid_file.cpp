// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/random.h"
#include "support/temporary_folder.h"

#include "vdbounce/base/error.h"
#include "vdbounce/field/distance_field.h"
#include "vdbounce/io/grid_file.h"
#include "vdbounce/io/openvdb_grid.h"

#include <catch2/catch.hpp>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

void writeRaw(const openvdb::GridBase::Ptr& grid, const std::string& path)
{
    openvdb::io::File file(path);
    file.write({grid});
}

// Compares phi with the definition in double precision, through the accessor of what OpenVDB itself holds.
template <class Grid> void requireTrilinear(const DistanceField& field, const Grid& grid, Random& random)
{
    const auto accessor = grid.getConstAccessor();
    const double ulps = 8.0 * std::numeric_limits<float>::epsilon() * double(grid.background());
    double worst = 0.0;
    for (int i = 0; i < 1000000; ++i) {
        const Vec3d index = random.in(field.indexBox());
        const openvdb::Coord base = openvdb::Coord::floor(openvdb::Vec3d(index.x(), index.y(), index.z()));
        double phi = 0.0;
        for (int corner = 0; corner < 8; ++corner) {
            const openvdb::Coord offset(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
            double weight = 1.0;
            for (int axis = 0; axis < 3; ++axis) {
                const double t = index[axis] - base[axis];
                weight *= offset[axis] == 1 ? t : 1.0 - t;
            }
            phi += weight * double(accessor.getValue(base + offset));
        }
        worst = std::max(worst, std::abs(field.phi(field.transform().toWorld(index)) - phi));
    }
    CHECK(worst <= ulps);
}

} // namespace

TEST_CASE("a level set reads back as it was written")
{
    const TemporaryFolder folder;
    const auto grid = bandGrid(sphere(1.0), uniformTransform(0.1), 16);
    grid->setName("ball");
    writeLevelSet(levelSet(grid), folder / "a.vdb");
    const LevelSetGrid back = readLevelSet(folder / "a.vdb");
    CHECK(toOpenVdb(back).tree().hasSameTopology(grid->tree()));
    for (auto voxel = grid->cbeginValueAll(); voxel; ++voxel) {
        REQUIRE(toOpenVdb(back).tree().getValue(voxel.getCoord()) == *voxel);
    }
    CHECK(summarize(back).name == "ball");
    CHECK(summarize(back).halfWidthVx == Approx(3.0));
    CHECK(summarize(back).activeVoxels == grid->activeVoxelCount());
    writeLevelSet(levelSet(grid), folder / "b.vdb");
    CHECK(readFile(folder / "a.vdb") == readFile(folder / "b.vdb"));
}

TEST_CASE("level sets stored as half and double are read")
{
    const TemporaryFolder folder;
    const auto grid = bandGrid(sphere(1.0), uniformTransform(0.1), 16);
    writeLevelSet(levelSet(grid), folder / "half.vdb", {/*half=*/true, {}});
    auto doubles = std::make_shared<openvdb::DoubleGrid>(*grid);
    doubles->setGridClass(openvdb::GRID_LEVEL_SET);
    writeRaw(doubles, folder / "double.vdb");
    CHECK(summarize(readLevelSet(folder / "half.vdb")).valueType == "half");
    VDBOUNCE_RANDOM(random);
    openvdb::io::File file(folder / "half.vdb");
    file.open();
    const auto halves = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid(file.beginName().gridName()));
    requireTrilinear(DistanceField(readLevelSet(folder / "half.vdb")), *halves, random);
    requireTrilinear(DistanceField(readLevelSet(folder / "double.vdb")), *doubles, random);
}

TEST_CASE("what is no level set is refused by name")
{
    openvdb::initialize();
    const TemporaryFolder folder;
    const auto named = [](const openvdb::GridBase::Ptr& grid, const char* name, openvdb::GridClass gridClass) {
        grid->setName(name);
        grid->setGridClass(gridClass);
        return grid;
    };
    auto fog = openvdb::FloatGrid::create(0.0f);
    writeRaw(named(fog, "density", openvdb::GRID_FOG_VOLUME), folder / "fog.vdb");
    auto unsignedField = openvdb::FloatGrid::create(3.0f);
    unsignedField->tree().setValueOn(openvdb::Coord(0, 0, 0), 0.0f);
    writeRaw(named(unsignedField, "udf", openvdb::GRID_UNKNOWN), folder / "unsigned.vdb");
    writeRaw(named(openvdb::Vec3SGrid::create(), "velocity", openvdb::GRID_UNKNOWN), folder / "vector.vdb");
    writeRaw(named(openvdb::FloatGrid::create(-1.0f), "flipped", openvdb::GRID_LEVEL_SET), folder / "background.vdb");
    auto frustum = openvdb::FloatGrid::create(1.0f);
    frustum->setTransform(openvdb::math::Transform::createFrustumTransform(
        openvdb::BBoxd(openvdb::Vec3d(0), openvdb::Vec3d(9)), 0.5, 2.0));
    writeRaw(named(frustum, "camera", openvdb::GRID_LEVEL_SET), folder / "frustum.vdb");

    CHECK_THROWS_WITH(readLevelSet(folder / "fog.vdb"), Catch::Contains("'density'") && Catch::Contains("fog volume"));
    CHECK_THROWS_WITH(readLevelSet(folder / "unsigned.vdb"), Catch::Contains("'udf'") && Catch::Contains("unsigned"));
    CHECK_THROWS_WITH(readLevelSet(folder / "vector.vdb"),
                      Catch::Contains("'velocity'") && Catch::Contains("no level set"));
    CHECK_THROWS_WITH(readLevelSet(folder / "background.vdb"),
                      Catch::Contains("'flipped'") && Catch::Contains("background -1"));
    CHECK_THROWS_WITH(readLevelSet(folder / "frustum.vdb"),
                      Catch::Contains("'camera'") && Catch::Contains("not linear"));
    CHECK_THROWS_WITH(readLevelSet(folder / "fog.vdb", "phi"), Catch::Contains("holds no grid 'phi' but 'density'"));
    CHECK_THROWS_AS(readLevelSet(folder.write("junk.vdb", "junk")), InputError);
    CHECK_THROWS_AS(readLevelSet(folder.write("empty.vdb", "")), InputError);
    CHECK_THROWS_AS(readLevelSet(folder / "missing.vdb"), InputError);
}

TEST_CASE("voxels that are not finite are refused with their place")
{
    auto grid = bandGrid(sphere(1.0), uniformTransform(0.1), 16);
    grid->setName("ball");
    grid->tree().setValueOn(openvdb::Coord(10, 1, 2), std::numeric_limits<float>::quiet_NaN());
    CHECK_THROWS_WITH(DistanceField(levelSet(grid)),
                      Catch::Contains("'ball'") && Catch::Contains("(10, 1, 2)") && Catch::Contains("nan"));
}

TEST_CASE("grids that share a name are told apart")
{
    const TemporaryFolder folder;
    const auto velocity = openvdb::Vec3SGrid::create();
    const auto ball = bandGrid(sphere(1.0), uniformTransform(0.1), 16);
    velocity->setName("a");
    ball->setName("a");
    openvdb::io::File(folder / "two.vdb").write(openvdb::GridPtrVec{velocity, ball});
    CHECK(summarize(readLevelSet(folder / "two.vdb")).activeVoxels == ball->activeVoxelCount());
    CHECK(listGrids(folder / "two.vdb").size() == 2);
    CHECK(readLevelSet(folder / "two.vdb", listGrids(folder / "two.vdb")[1].name).holder().grid->activeVoxelCount() >
          0);
}

TEST_CASE("a level set that is cut short anywhere is refused by name")
{
    const TemporaryFolder folder;
    writeLevelSet(levelSet(bandGrid(sphere(1.0), uniformTransform(0.1), 16)), folder / "whole.vdb");
    const std::string whole = readFile(folder / "whole.vdb");
    // OpenVDB does not notice that the last values' very last bytes are missing.
    for (std::size_t length = 0; length + 64 < whole.size(); length += whole.size() / 40) {
        folder.write("cut.vdb", whole.substr(0, length));
        INFO(length << " of " << whole.size() << " bytes");
        CHECK_THROWS_AS(readLevelSet(folder / "cut.vdb"), InputError);
    }
}
