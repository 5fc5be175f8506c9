// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/run_tool.h"
#include "support/temporary_folder.h"

#include "vdbounce/io/grid_file.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>

using namespace vdbounce;
using namespace vdbounce::test;
using Json = nlohmann::json;

namespace {

// A sphere's level set with doubled gradient.
std::string doubled(const TemporaryFolder& folder)
{
    const openvdb::FloatGrid::Ptr grid = bandGrid(sphere(1.0), uniformTransform(0.0625), 24);
    for (auto it = grid->beginValueOn(); it; ++it) it.setValue(2.0f * *it);
    grid->setName("twice");
    writeLevelSet(levelSet(grid), folder / "twice.vdb");
    return folder / "twice.vdb";
}

} // namespace

TEST_CASE("redistance restores distances, band and name as asked")
{
    const TemporaryFolder folder;
    const std::string output = folder / "out.vdb";
    const ToolRun run = runTool("redistance " + doubled(folder) + " -o " + output + " --band 4vx --name ball --json");
    INFO(run.err);
    REQUIRE(run.exitCode == 0);
    const Json json = Json::parse(run.out);
    CHECK(json["voxel_size"] == 0.0625);
    CHECK(json["band"] == 0.25);
    CHECK(json["active_voxels"] > 20000);
    for (const char* key : {"read", "build", "write"}) CHECK(json["seconds"][key].is_number());

    const Json held = Json::parse(runTool("info --json " + output).out)["files"][0]["holds"][0];
    CHECK(held["name"] == "ball");
    CHECK(held["half_width_vx"].get<double>() == Approx(4.0));
    CHECK(held["verdict"] == "fit to collide with");
}

TEST_CASE("redistance takes another value than zero for the surface")
{
    const TemporaryFolder folder;
    const std::string input = doubled(folder);
    const auto volume = [&](const std::string& options) {
        REQUIRE(runTool("redistance " + input + " -o " + (folder / "out.vdb") + options).exitCode == 0);
        return Json::parse(runTool("redistance " + input + " -o " + (folder / "out.vdb") + options + " --json")
                               .out)["active_voxels"]
            .get<double>();
    };
    // The shell's volume goes with the radius squared: 1 + 0.0625 of iso 0.125 at a gradient of 2.
    CHECK(volume(" --iso 0.125") / volume("") == Approx(1.0625 * 1.0625).epsilon(0.01));
    CHECK(volume(" --exterior 0.125 --interior 2vx --half") / volume("") == Approx(2.0 / 3.0).epsilon(0.02));
}

TEST_CASE("redistance refuses what it cannot do")
{
    const TemporaryFolder folder;
    const std::string input = doubled(folder);
    const auto refused = [&](const std::string& options, int code, const std::string& text) {
        const ToolRun run = runTool("redistance " + input + options);
        CHECK(run.exitCode == code);
        CHECK_THAT(run.err, Catch::Contains(text));
    };
    refused(" -o " + input, 2, "");
    refused(" -o " + (folder / "o.vdb") + " --band 3vx --interior 2vx", 2, "--band excludes");
    refused(" -o " + (folder / "o.vdb") + " --band 0.5vx", 2, "out of range");
    refused(" -o " + (folder / "o.vdb") + " --iso 9", 3, "never takes the value 9");
    refused(" -o " + (folder / "o.vdb") + " --band 50vx --max-memory 10M", 2, "more memory than is allowed");
    refused(" -o " + (folder / "o.vdb") + " --band 900000vx", 2, "more memory than is allowed");
    refused(" -o " + (folder / "o.vdb") + " --inside left", 2, "is not a choice");
}
