// SPDX-License-Identifier: Apache-2.0
#include "implicit/csg_grids.h"
#include "support/run_tool.h"
#include "support/temporary_folder.h"

#include "vdbounce/io/grid_file.h"

#include <nlohmann/json.hpp>

using namespace vdbounce;
using namespace vdbounce::test;
using Json = nlohmann::json;

namespace {

// Two balls of radius 6 that overlap, on voxels of 1, a small one on voxels of 0.5.
struct Balls {
    TemporaryFolder folder;
    LevelSetGrid a = bandLevelSet(sphere(6.0), 16);
    LevelSetGrid b = bandLevelSet(sphere(6.0, Vec3d(5, 0, 0)), 16);
    LevelSetGrid c = bandLevelSet(sphere(3.0, Vec3d(0, 5, 0)), 20, 6.0, uniformTransform(0.5));

    Balls()
    {
        writeLevelSet(a, folder / "a.vdb");
        writeLevelSet(b, folder / "b.vdb");
        writeLevelSet(c, folder / "c.vdb");
    }

    // "a b" for the files.
    ToolRun run(const std::string& operation, const std::string& operands, const std::string& flags = "") const
    {
        std::string files;
        for (char operand : operands) files += " " + (folder / (std::string(1, operand) + ".vdb"));
        return runTool("csg " + operation + files + " -o " + (folder / "o.vdb") + " --json " + flags);
    }
};

} // namespace

TEST_CASE("csg combines files as the library does grids")
{
    const Balls balls;
    const std::pair<std::string, CsgOperation> operations[] = {{"union", CsgOperation::Union},
                                                               {"intersect", CsgOperation::Intersection},
                                                               {"subtract", CsgOperation::Subtraction}};
    for (const auto& [word, operation] : operations) {
        const ToolRun run = balls.run(word, "ab", "--name both");
        INFO(run.err);
        REQUIRE(run.exitCode == 0);
        const Json json = Json::parse(run.out);
        CHECK(json["operation"] == word);
        CHECK(json["notes"].empty());
        CHECK(json["half_width_vx"] == 3.0);
        const LevelSetGrid read = readLevelSet(balls.folder / "o.vdb");
        CHECK(differences(read, made(operation, balls.a, balls.b), 20) == 0);
        CHECK(json["active_voxels"] == toOpenVdb(read).activeVoxelCount());
        CHECK(toOpenVdb(read).getName() == "both");
        for (const char* part : {"read", "build", "write"}) CHECK(json["seconds"][part].is_number());
    }
}

TEST_CASE("csg takes more than two files together and notes what it resampled")
{
    const Balls balls;
    const ToolRun run = balls.run("union", "abc");
    REQUIRE(run.exitCode == 0);
    const Json json = Json::parse(run.out);
    REQUIRE(json["notes"].size() == 1);
    CHECK_THAT(json["notes"][0].get<std::string>(), Catch::StartsWith("resampled: "));
    CHECK(json["voxel_size"][0] == 0.5);
    const LevelSetGrid expected = made(CsgOperation::Union, made(CsgOperation::Union, balls.a, balls.b), balls.c);
    CHECK(differences(readLevelSet(balls.folder / "o.vdb"), expected, 36) == 0);
    CHECK(Json::parse(balls.run("union", "abc", "--voxels first").out)["voxel_size"][0] == 1.0);
}

TEST_CASE("csg complement turns a file inside out")
{
    const Balls balls;
    REQUIRE(balls.run("complement", "a").exitCode == 0);
    CHECK(differences(readLevelSet(balls.folder / "o.vdb"), complement(balls.a).grid, 30) == 0);
    const ToolRun sampled = [&] {
        balls.folder.write("at.csv", "x,y,z\n0,0,0\n0,7,0\n0,500,0\n");
        return runTool("sample " + (balls.folder / "o.vdb") + " --at " + (balls.folder / "at.csv") + " -o " +
                       (balls.folder / "s.csv"));
    }();
    REQUIRE(sampled.exitCode == 0);
    const std::string rows = readFile(balls.folder / "s.csv");
    CHECK_THAT(rows,
               Catch::Contains("\n0,0,0,3,") && Catch::Contains("\n0,7,0,-1,") && Catch::Contains("\n0,500,0,-49"));
}

TEST_CASE("csg refuses wrong operands in one line")
{
    const Balls balls;
    const auto requireRefused = [&](const ToolRun& run, int exitCode, const std::string& contains) {
        INFO(run.err);
        CHECK(run.exitCode == exitCode);
        CHECK(lineCount(run.err) == 1);
        CHECK_THAT(run.err, Catch::StartsWith("vdbounce: error: ") && Catch::Contains(contains));
    };
    requireRefused(balls.run("union", "a"), 2, "two level sets are needed");
    requireRefused(balls.run("complement", "ab"), 2, "complement is of one level set");
    requireRefused(balls.run("complement", "a", "--blend 1vx"), 2, "--blend");
    requireRefused(balls.run("xor", "ab"), 2, "'xor' is no operation");
    requireRefused(balls.run("union", "ab", "--blend -1"), 2, "--blend");
    requireRefused(balls.run("union", "ab", "--voxels b"), 2, "use one of: finest, first");
    requireRefused(balls.run("union", "az"), 3, "z.vdb");
    requireRefused(runTool("csg union " + (balls.folder / "a.vdb") + " " + (balls.folder / "b.vdb") + " -o " +
                           (balls.folder / "a.vdb")),
                   2, "which writing would destroy");
}
