// SPDX-License-Identifier: Apache-2.0
#include "support/run_tool.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace vdbounce::test;
using Json = nlohmann::json;

namespace {

Json holdsOf(const std::string& path)
{
    return Json::parse(runTool("info --json " + path).out)["files"][0]["holds"][0];
}

} // namespace

TEST_CASE("blobs turns particles into a level set by every kernel")
{
    const TemporaryFolder folder;
    REQUIRE(runTool("emit sphere --center 0,0,0 --radius 1 -n 500 -o " + (folder / "a.csv")).exitCode == 0);
    for (const char* kernel : {"gaussian", "compact", "sphere"}) {
        const ToolRun run = runTool("blobs " + (folder / "a.csv") + " -o " + (folder / "b.vdb") +
                                    " --voxel 0.1 --radius 2vx --band 4vx --name drops --json --kernel " + kernel);
        INFO(run.err);
        REQUIRE(run.exitCode == 0);
        const Json json = Json::parse(run.out);
        CHECK(json["particles"] == 500);
        CHECK(json["voxel_size"] == 0.1);
        CHECK(json["active_voxels"] > 1000);
        CHECK(json["warnings"].empty());
        CHECK(json["seconds"].contains("build"));
        const Json holds = holdsOf(folder / "b.vdb");
        CHECK(holds["name"] == "drops");
        CHECK(holds["half_width_vx"].get<double>() == Approx(4.0));
        CHECK(runTool("collide --collider " + (folder / "b.vdb") + " --particles " + (folder / "a.csv") + " -o " +
                      (folder / "c.csv") + " --dt 0.01 --steps 2")
                  .exitCode == 0);
    }
}

TEST_CASE("blobs takes radii of the file, and threshold and strength")
{
    const TemporaryFolder folder;
    const std::string one = folder.write("one.csv", "x,y,z,radius\n0,0,0,1\n");
    const auto active = [&](const std::string& options) {
        const ToolRun run = runTool("blobs " + one + " -o " + (folder / "b.vdb") + " --voxel 0.1 --json " + options);
        INFO(run.err);
        REQUIRE(run.exitCode == 0);
        return Json::parse(run.out)["active_voxels"].get<std::uint64_t>();
    };
    // 4 pi r^2 times the band, with r 10 voxels and then 15.
    const double plain = double(active(""));
    CHECK(plain == Approx(4.0 * M_PI * 100.0 * 6.0).epsilon(0.05));
    CHECK(double(active("--radius 0.3")) == plain); // the file carries its own
    CHECK(double(active("--threshold 0.10539922")) == Approx(plain * 2.25).epsilon(0.05));
    CHECK(double(active("--threshold 0.36787944 --strength 3.4903430")) == Approx(plain * 2.25).epsilon(0.05));
    CHECK(double(active("--kernel sphere")) == Approx(plain).epsilon(0.02));
}

TEST_CASE("blobs counts what makes no surface and refuses what cannot be made")
{
    const TemporaryFolder folder;
    const std::string odd =
        folder.write("odd.csv", "x,y,z,radius\n0,0,0,1\nnan,0,0,1\n1,1,1,0\n2,2,2,-3\n0.05,0.05,3.05,0.01\n");
    const std::string command = "blobs " + odd + " -o " + (folder / "b.vdb") + " --json --kernel sphere --voxel ";
    const ToolRun run = runTool(command + "0.1");
    REQUIRE(run.exitCode == 0);
    const Json json = Json::parse(run.out);
    CHECK(json["particles"] == 2);
    CHECK(json["left_out"]["not_finite"] == 1);
    CHECK(json["left_out"]["no_radius"] == 2);
    CHECK(json["without_surface"] == 1);
    CHECK(json["warnings"].size() == 3);

    const std::string bare = folder.write("bare.csv", "x,y,z\n0,0,0\n");
    const auto refused = [&](const std::string& options, int exitCode) {
        const std::string output = folder / "refused.vdb";
        const ToolRun failed = runTool("blobs " + bare + " -o " + output + " " + options);
        INFO(options << ": " << failed.err);
        CHECK(failed.exitCode == exitCode);
        CHECK(lineCount(failed.err) == 1);
        CHECK_FALSE(std::ifstream(output).good());
    };
    refused("--voxel 0.1", 2); // no radius anywhere
    refused("--voxel 0.1 --radius -1", 2);
    refused("--voxel 0 --radius 1", 2);
    refused("--voxel 2vx --radius 1", 2);
    refused("--radius 1", 2);
    refused("--voxel 0.1 --radius 1 --kernel cubic", 2);
    refused("--voxel 0.1 --radius 1 --kernel sphere --threshold 0.5", 2);
    refused("--voxel 0.1 --radius 1 --threshold 3", 3); // nothing is so dense
    refused("--voxel 0.1 --radius 1e12", 3);
    refused("--voxel 0.1 --radius 1 --band 0.2vx", 2);
    // Soon, and not when memory is out.
    for (const char* kernel : {"sphere", "gaussian", "compact"})
        refused(std::string("--voxel 1e-4 --radius 10 --max-memory 50M --kernel ") + kernel, 2);
}
