// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/run_tool.h"
#include "support/temporary_folder.h"

#include "vdbounce/io/grid_file.h"
#include "vdbounce/io/vdb_archive.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <openvdb/tools/LevelSetUtil.h>

#include <cmath>
#include <limits>

using namespace vdbounce;
using namespace vdbounce::test;
using Json = nlohmann::json;

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kVoxel = 0.1;

// What info tells of the only grid in a file.
Json infoOf(const std::string& path)
{
    const ToolRun run = runTool("info --json " + path);
    INFO(run.err);
    REQUIRE(run.exitCode == 0);
    const Json holds = Json::parse(run.out)["files"][0]["holds"];
    REQUIRE(holds.size() == 1);
    // What is written for people holds the same verdict.
    const ToolRun text = runTool("info " + path);
    REQUIRE(text.exitCode == 0);
    CHECK_THAT(text.out, Catch::Contains(holds[0]["verdict"].get<std::string>()));
    return holds[0];
}

Json infoOf(const openvdb::FloatGrid::Ptr& grid)
{
    const TemporaryFolder folder;
    grid->setName("it");
    writeVdbFile({grid}, folder / "it.vdb");
    return infoOf(folder / "it.vdb");
}

openvdb::FloatGrid::Ptr ballGrid(double halfWidthVx = 3.0)
{
    return bandGrid(sphere(1.2, Vec3d(0.01, 0.02, 0.03)), uniformTransform(kVoxel), 18, halfWidthVx);
}

openvdb::FloatGrid::Ptr changed(openvdb::FloatGrid::Ptr grid, const std::function<float(float)>& change)
{
    for (auto it = grid->beginValueAll(); it; ++it) it.setValue(change(*it));
    grid->tree().root().setBackground(change(grid->background()), /*updateChildNodes=*/false);
    return grid;
}

} // namespace

TEST_CASE("info measures a sphere and finds it fit")
{
    const Json info = infoOf(ballGrid());
    CHECK(info["kind"] == "level set");
    CHECK(info["class"] == "level set");
    CHECK(info["verdict"] == "fit to collide with");
    CHECK(info["fit"] == "yes");
    CHECK(info["faults"].empty());
    CHECK(info["transform"]["cubes"] == true);
    CHECK(info["transform"]["turned_deg"] == 0.0);
    CHECK(info["transform"]["sheared"] == false);
    CHECK(info["band"]["exterior"].get<double>() == Approx(0.3));
    CHECK(info["band"]["interior_vx"].get<double>() == Approx(3.0));
    CHECK(info["closed"] == true);
    CHECK(info["clipped"] == false);
    CHECK(info["eikonal"]["voxels"] > 1000);
    CHECK(info["eikonal"]["mean"] < 0.005);
    CHECK(info["eikonal"]["largest"] < 0.02);
    CHECK(info["eikonal"]["where"].size() == 3);
    CHECK(info["components"] == 1);
    CHECK(info["cavities"] == 0);
    CHECK(info["volume"].get<double>() == Approx(4.0 / 3.0 * kPi * 1.2 * 1.2 * 1.2).epsilon(0.01));
    CHECK(info["area"].get<double>() == Approx(4.0 * kPi * 1.2 * 1.2).epsilon(0.01));
    CHECK(info["smallest_feature_vx"].is_null());
}

TEST_CASE("info says what a body of several pieces consists of, and how thin its walls are")
{
    const Json info = infoOf(bandGrid(
        [](const Vec3d& p) {
            const double hollow = std::max(p.norm() - 1.2, 0.75 - p.norm());
            return std::min(hollow, p.norm() - 0.3);
        },
        uniformTransform(kVoxel), 18));
    CHECK(info["components"] == 2);
    CHECK(info["cavities"] == 1);
    CHECK(info["fit"] == "yes");
    // Between the shell and the ball, and through the shell, it is four and a half voxels.
    CHECK(info["smallest_feature_vx"].get<double>() == Approx(4.5).epsilon(0.03));
}

TEST_CASE("values that are no distances are not fit, and redistance is named")
{
    for (const float factor : {0.5f, 2.0f}) {
        const Json info = infoOf(changed(ballGrid(), [=](float v) { return factor * v; }));
        CHECK(info["fit"] == "no");
        CHECK_THAT(info["verdict"].get<std::string>(),
                   Catch::StartsWith("not fit to collide with") && Catch::Contains("|grad phi|"));
        CHECK_THAT(info["faults"].front()["remedy"].get<std::string>(), Catch::StartsWith("vdbounce redistance"));
    }
    const Json cubic = infoOf(changed(ballGrid(), [](float v) { return v + 10.0f * v * v * v; }));
    CHECK(cubic["fit"] == "no");
    CHECK(cubic["eikonal"]["median"] > 0.1);
}

TEST_CASE("a band that is too thin is not fit, and the command that widens it is named")
{
    const Json info = infoOf(ballGrid(1.5));
    CHECK(info["fit"] == "no");
    CHECK(info["band"]["exterior_vx"].get<double>() == Approx(1.5));
    CHECK_THAT(info["verdict"].get<std::string>(), Catch::Contains("--band 3vx"));
}

TEST_CASE("a level set that its box cuts off is fit within it, and its volume is not known")
{
    const Json info = infoOf(bandGrid(halfSpace(Vec3d(1, 3, 2)), uniformTransform(kVoxel), 10));
    CHECK(info["fit"] == "with reservations");
    CHECK(info["clipped"] == true);
    CHECK(info["closed"] == false);
    for (const char* key : {"volume", "area", "components", "cavities"}) CHECK(info[key].is_null());
    CHECK(info["area_in_box"] > 4.0);
    CHECK_THAT(info["verdict"].get<std::string>(), Catch::StartsWith("fit to collide with, but only inside its box"));
}

TEST_CASE("what cannot be collided with is told without failing")
{
    const auto empty = openvdb::FloatGrid::create(0.3f);
    empty->setGridClass(openvdb::GRID_LEVEL_SET);
    CHECK_THAT(infoOf(empty)["verdict"].get<std::string>(), Catch::Contains("it is empty"));

    const auto outside = denseGrid([](const Vec3d&) { return 0.5; }, uniformTransform(kVoxel), 5);
    CHECK_THAT(infoOf(outside)["verdict"].get<std::string>(), Catch::Contains("no surface"));
    const auto inside = denseGrid([](const Vec3d&) { return -0.5; }, uniformTransform(kVoxel), 5);
    CHECK(infoOf(inside)["fit"] == "no");

    const auto broken = ballGrid();
    broken->getAccessor().setValueOn(openvdb::Coord(12, 1, 2), std::numeric_limits<float>::quiet_NaN());
    const Json notFinite = infoOf(broken);
    CHECK(notFinite["fit"] == "no");
    CHECK_THAT(notFinite["verdict"].get<std::string>(), Catch::Contains("not finite") && Catch::Contains("(12, 1, 2)"));

    const auto upsideDown = openvdb::FloatGrid::create(-0.3f);
    upsideDown->setGridClass(openvdb::GRID_LEVEL_SET);
    CHECK_THAT(infoOf(upsideDown)["verdict"].get<std::string>(), Catch::Contains("background"));

    const auto tiles = openvdb::FloatGrid::create(0.3f);
    tiles->setGridClass(openvdb::GRID_LEVEL_SET);
    tiles->tree().addTile(3, openvdb::Coord(0), -0.3f, /*active=*/true);
    CHECK(infoOf(tiles)["fit"] == "no");

    auto oneVoxel = openvdb::FloatGrid::create(0.3f);
    oneVoxel->setGridClass(openvdb::GRID_LEVEL_SET);
    oneVoxel->getAccessor().setValueOn(openvdb::Coord(3), -0.1f);
    CHECK(infoOf(oneVoxel)["active_voxels"] == 1);
}

TEST_CASE("fog and other grids are told apart, and the command that makes a level set is named")
{
    auto fog = ballGrid();
    openvdb::tools::sdfToFogVolume(*fog);
    const Json info = infoOf(fog);
    CHECK(info["kind"] == "fog volume");
    CHECK(info["fit"] == "no");
    CHECK(info["highest"] == 1.0);
    CHECK_THAT(info["verdict"].get<std::string>(),
               Catch::Contains("fog volume") && Catch::Contains("vdbounce redistance") && Catch::Contains("--iso 0.5"));

    const auto numbers = openvdb::FloatGrid::create(0.0f);
    numbers->getAccessor().setValueOn(openvdb::Coord(1), 7.0f);
    CHECK_THAT(infoOf(numbers)["verdict"].get<std::string>(),
               Catch::Contains("no level set") && Catch::Contains("--iso"));

    auto unnamed = ballGrid();
    unnamed->setGridClass(openvdb::GRID_UNKNOWN);
    const Json unknown = infoOf(unnamed);
    CHECK(unknown["kind"] == "level set");
    CHECK(unknown["class"] == "unknown");
    CHECK(unknown["fit"] == "with reservations");

    const TemporaryFolder folder;
    writeVdbFile({openvdb::Vec3SGrid::create()}, folder / "v.vdb");
    CHECK(infoOf(folder / "v.vdb")["kind"] == "other");
    auto frustum = ballGrid();
    frustum->setTransform(openvdb::math::Transform::createFrustumTransform(
        openvdb::BBoxd(openvdb::Vec3d(-20), openvdb::Vec3d(20)), 0.5, 10.0, 0.1));
    CHECK_THAT(infoOf(frustum)["verdict"].get<std::string>(), Catch::Contains("resample"));
}

TEST_CASE("the transform is told in plain words")
{
    const auto words = [](const Mat3d& rows) {
        const auto grid = bandGrid(sphere(0.8), affineTransform(rows, Vec3d(1, 2, 3)), 16, 4.0);
        return infoOf(grid)["transform"];
    };
    const Mat3d cubes = 0.1 * Mat3d::Identity();
    CHECK(words(cubes)["words"] == "cubes of side 0.1 along the world's axes");
    CHECK(words(cubes)["origin"] == Json({1.0, 2.0, 3.0}));
    CHECK(words(Vec3d(0.1, 0.1, 0.12).asDiagonal())["words"] == "sides 0.1, 0.1, 0.12 along the world's axes");
    CHECK(words(Vec3d(0.1, 0.1, -0.1).asDiagonal())["words"] == "cubes of side 0.1 along the world's axes, mirrored");
    // Row vectors: a turn by 30 degrees about z.
    Mat3d turned = cubes;
    turned.topLeftCorner<2, 2>() << 0.1 * std::cos(kPi / 6), 0.1 * std::sin(kPi / 6), -0.1 * std::sin(kPi / 6),
        0.1 * std::cos(kPi / 6);
    CHECK(words(turned)["words"] == "cubes of side 0.1, turned by 30 degrees about (0, 0, 1)");
    Mat3d sheared = cubes;
    sheared(1, 0) = 0.1;
    const Json skew = words(sheared);
    CHECK(skew["sheared"] == true);
    CHECK(skew["angles_deg"][2].get<double>() == Approx(45.0));
    CHECK_THAT(skew["words"].get<std::string>(), Catch::Contains("axes meet at 90, 90 and 45 degrees"));
}

TEST_CASE("walls that voxels are too large for make a verdict where they are much of the surface")
{
    const auto plate = [](double thicknessVx) {
        return infoOf(bandGrid(
            [=](const Vec3d& p) {
                return std::max(std::abs(p.y() - 0.02) - 0.5 * thicknessVx * kVoxel, p.norm() - 1.5);
            },
            uniformTransform(kVoxel), 20));
    };
    const Json thin = plate(0.9);
    CHECK(thin["fit"] == "with reservations");
    CHECK(thin["smallest_feature_vx"].get<double>() == Approx(0.9).epsilon(0.01));
    CHECK(thin["smallest_feature"]["kind"] == "wall");
    CHECK_THAT(thin["verdict"].get<std::string>(), Catch::Contains("--voxel 0.03"));
    const Json thick = plate(4.0);
    CHECK(thick["fit"] == "yes");
    CHECK(thick["smallest_feature_vx"].get<double>() == Approx(4.0).epsilon(0.01));
}
