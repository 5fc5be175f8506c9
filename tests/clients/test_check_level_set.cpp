// SPDX-License-Identifier: Apache-2.0
#include "support/run_tool.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>
#include <openvdb/io/File.h>
#include <openvdb/tools/Diagnostics.h>

using namespace vdbounce::test;

namespace {

// OpenVDB's checks of level sets, and those of them that a surface with edges passes: all but the unit gradient.
constexpr std::size_t kAllChecks = 9;
constexpr std::size_t kChecksOfEdges = 8;

// A folder with a file of heights, one of particles, and what the tool makes there.
struct Files {
    TemporaryFolder folder;

    Files()
    {
        folder.write("hill.csv", "0,1,0\n0,1,0\n");
        folder.write("drops.csv", "x,y,z,radius\n0,0,0,0.5\n0.61,0.02,0,0.3\n0.3,0.5,0.1,0.07\n");
    }

    // What OpenVDB finds wrong with the result of these words, in which files begin with @.
    std::string complaint(std::string words, const std::string& output, std::size_t checks) const
    {
        const std::string path = folder / "";
        for (std::size_t at = 0; (at = words.find('@', at)) != std::string::npos; at += path.size())
            words.replace(at, 1, path);
        const ToolRun run = runTool(words + " --quiet -o " + (folder / output));
        REQUIRE(run.err == "");
        openvdb::io::File file(folder / output);
        file.open();
        const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("surface"));
        return openvdb::tools::checkLevelSet(*grid, checks);
    }
};

} // namespace

TEST_CASE("OpenVDB's checkLevelSet accepts the files of every shape", "[clients]")
{
    openvdb::initialize();
    const Files files;
    const std::pair<const char*, std::size_t> shapes[] = {
        {"sphere --center 0,1,0 --radius 0.5", kAllChecks},
        {"ellipsoid --center 0,0,0 --radii 0.6,0.3,0.5", kAllChecks},
        {"capsule --from 0,0,0 --to 0,0.5,0 --radius 0.2", kAllChecks},
        {"torus --center 0,0,0 --axis 0,1,0 --major 0.5 --minor 0.2", kAllChecks},
        {"box --center 0,0,0 --half 0.51,0.23,0.37 --rotate 0.9,0.1,0.3,0.2", kChecksOfEdges},
        {"cylinder --from 0,0,0 --to 0.1,0.5,0.2 --radius 0.2", kChecksOfEdges},
        {"cone --from 0,0,0 --to 0.1,0.6,0.2 --radius 0.4", kChecksOfEdges},
        {"heightfield @hill.csv --min=-1,0,-1 --max 1,0.5,1", kChecksOfEdges}};
    for (const auto& [shape, checks] : shapes) {
        INFO(shape);
        for (const char* voxel : {"0.05", "0.0213", "0.01"}) {
            INFO(voxel);
            CHECK(files.complaint(std::string("make ") + shape + " --voxel " + voxel, "o.vdb", checks) == "");
        }
    }
}

TEST_CASE("OpenVDB's checkLevelSet accepts files of blobs, set operations and redistancing", "[clients]")
{
    openvdb::initialize();
    const Files files;
    for (const char* kernel : {"gaussian", "compact", "sphere"}) {
        INFO(kernel);
        const std::string blobs = std::string("blobs @drops.csv --voxel 0.02 --kernel ") + kernel;
        CHECK(files.complaint(blobs, "blobs.vdb", kChecksOfEdges) == "");
    }
    const std::string place = "--voxel 0.02 --center 0.3,0.1,0";
    REQUIRE(files.complaint("make box --half 0.3,0.2,0.4 " + place, "box.vdb", kChecksOfEdges) == "");
    for (const char* operation : {"union", "intersect", "subtract"}) {
        INFO(operation);
        const std::string csg = std::string("csg ") + operation + " @blobs.vdb @box.vdb";
        CHECK(files.complaint(csg, "csg.vdb", kChecksOfEdges) == "");
        CHECK(files.complaint(csg + " --redistance", "csg.vdb", kChecksOfEdges) == "");
        CHECK(files.complaint("redistance @csg.vdb --band 5vx", "wide.vdb", kChecksOfEdges) == "");
    }
    REQUIRE(files.complaint("make torus --major 0.5 --minor 0.2 --axis 1,2,3 " + place, "torus.vdb", kAllChecks) == "");
    CHECK(files.complaint("redistance @torus.vdb --iso 0.013 --band 4vx", "out.vdb", kAllChecks) == "");
}
