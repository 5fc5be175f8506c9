// SPDX-License-Identifier: Apache-2.0
#include "support/run_tool.h"
#include "support/temporary_folder.h"

#include "vdbounce/field/distance_field.h"
#include "vdbounce/io/grid_file.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>

using namespace vdbounce;
using namespace vdbounce::test;
using Json = nlohmann::json;

TEST_CASE("make writes each shape as a level set whose surface is where it should be")
{
    struct Shape {
        const char* arguments;
        Vec3d on; // a point of its surface
    };
    const Shape shapes[] = {
        {"sphere --center 0,1,0 --radius 0.5", Vec3d(0, 1.5, 0)},
        {"box --center 0,0,0 --half 0.5,0.2,0.3", Vec3d(0.1, 0.2, 0.1)},
        {"box --center 0,0,0 --half 0.5,0.2,0.3 --rotate 0.70710678,0,0,0.70710678", Vec3d(0.2, 0.1, 0.1)},
        {"torus --center 0,0,0 --axis 0,1,0 --major 0.5 --minor 0.2", Vec3d(0.7, 0, 0)},
        {"capsule --from 0,0,0 --to 0,0.5,0 --radius 0.2", Vec3d(0, 0.7, 0)},
        {"cylinder --from 0,0,0 --to 0,0.5,0 --radius 0.2", Vec3d(0.2, 0.2, 0)},
        {"cone --from 0,0,0 --to 0,0.5,0 --radius 0.3", Vec3d(0.15, 0.25, 0)},
        {"cone --from 0,0,0 --to 0,0.5,0 --radius 0.3 --top-radius 0.1", Vec3d(0.2, 0.25, 0)},
        {"ellipsoid --center 0,0,0 --radii 0.5,0.2,0.3", Vec3d(0, 0.2, 0)},
        {"plane --point 0,0.1,0 --normal 0,1,0 --min -1,-0.5,-1 --max 1,0.5,1", Vec3d(0.1, 0.1, 0)}};
    const TemporaryFolder folder;
    for (const Shape& shape : shapes) {
        const std::string file = folder / "shape.vdb";
        const ToolRun done = runTool(std::string("make ") + shape.arguments + " --voxel 0.02 --json -o " + file);
        INFO(shape.arguments << ": " << done.err);
        REQUIRE(done.exitCode == 0);
        const Json json = Json::parse(done.out);
        CHECK(json["voxel_size"] == 0.02);
        CHECK(json["active_voxels"] > 1000);
        const DistanceField field(readLevelSet(file));
        CHECK(field.phi(shape.on) == Approx(0.0).margin(2e-3));
        CHECK(field.background() == Approx(0.06));
        std::filesystem::remove(file);
    }
}

TEST_CASE("make makes the solid under a map of heights")
{
    const TemporaryFolder folder;
    folder.write("hills.csv", "0,0,0\n0,1,0\n0,0,0\n");
    const std::string file = folder / "hills.vdb";
    const ToolRun done = runTool("make heightfield " + (folder / "hills.csv") +
                                 " --min -1,0,-1 --max 1,0.5,1 --base -0.5 --voxel 0.02 --json -o " + file);
    INFO(done.err);
    REQUIRE(done.exitCode == 0);
    const DistanceField field(readLevelSet(file));
    CHECK(field.phi(Vec3d(0.5, 0.25, 0.0)) == Approx(0.0).margin(2e-3)); // half way up the hill
    CHECK(field.phi(Vec3d(0.3, -0.5, 0.2)) == Approx(0.0).margin(2e-3)); // the bottom
    CHECK(field.phi(Vec3d(1.04, -0.2, 0.2)) == Approx(0.04).margin(2e-3));
    const ToolRun wrong = runTool("make heightfield " + (folder / "hills.csv") +
                                  " --min -1,0,-1 --max 1,0.5,1 --base 0.1 --voxel 0.02 -o " + (folder / "no.vdb"));
    CHECK(wrong.exitCode == 2);
    CHECK(wrong.err.find("base") != std::string::npos);
    folder.write("bad.csv", "0,0\n0,x\n");
    const ToolRun bad = runTool("make heightfield " + (folder / "bad.csv") +
                                " --min -1,0,-1 --max 1,0.5,1 --voxel 0.02 -o " + (folder / "no.vdb"));
    CHECK(bad.exitCode == 3);
    CHECK(lineCount(bad.err) == 1);
}

TEST_CASE("make takes bands, a name and half floats as mesh2ls does")
{
    const TemporaryFolder folder;
    const std::string file = folder / "ball.vdb";
    const ToolRun done = runTool("make sphere --center 0,0,0 --radius 0.5 --voxel 0.02 --exterior 5vx --interior 0.08 "
                                 "--name ball --half-floats --quiet -o " +
                                 file);
    REQUIRE(done.exitCode == 0);
    CHECK(done.out.empty());
    const LevelSetSummary summary = summarize(readLevelSet(file, "ball"));
    CHECK(summary.valueType == "half");
    CHECK(summary.background == Approx(0.1).epsilon(1e-3));
    CHECK(DistanceField(readLevelSet(file)).interior() == Approx(0.08).epsilon(1e-3));
}

TEST_CASE("make refuses what makes no shape in one line, and leaves no file")
{
    const std::pair<const char*, const char*> wrong[] = {
        {"sphere --center 0,0,0 --radius -1 --voxel 0.1", "sphere radius: -1 is out of range"},
        {"sphere --center 0,0,0 --radius 1 --voxel 0", "voxel size"},
        {"torus --center 0,0,0 --major 1 --minor 2 --voxel 0.1", "torus minor"},
        {"sphere --center 0,0,0 --radius 1 --voxel 0.1 --band 3vx --exterior 4vx", "--band"},
        {"sphere --center 0,0,0 --radius 1e6 --voxel 1e-3 --max-memory 1G", "more memory than is allowed"},
        {"sphere --radius 1 --voxel 0.1", "--center is required"},
        {"blob --voxel 0.1", "make"}};
    const TemporaryFolder folder;
    for (const auto& [arguments, message] : wrong) {
        const std::string file = folder / "shape.vdb";
        const ToolRun done = runTool(std::string("make ") + arguments + " -o " + file);
        INFO(arguments << ": " << done.err);
        CHECK(done.exitCode == 2);
        CHECK(lineCount(done.err) == 1);
        CHECK(done.err.find(message) != std::string::npos);
        CHECK_FALSE(std::filesystem::exists(file));
    }
}
