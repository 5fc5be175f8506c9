// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/run_tool.h"
#include "support/temporary_folder.h"

#include "vdbounce/io/grid_file.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <map>
#include <set>

using namespace vdbounce;
using namespace vdbounce::test;
using Json = nlohmann::json;

TEST_CASE("mesh2ls reports what the contract says")
{
    const TemporaryFolder folder;
    const ToolRun run = runTool("mesh2ls " + sourcePath("data/bunny.obj") + " -o " + (folder / "b.vdb") +
                                " --dim 64 --name bunny --verify --json");
    INFO(run.err);
    REQUIRE(run.exitCode == 0);
    const Json json = Json::parse(run.out);
    CHECK(json["triangles"] == 3674);
    CHECK(json["voxel_size"].get<double>() == Approx(9.907325 / 64).epsilon(1e-4));
    CHECK(json["active_voxels"] > 10000);
    CHECK(json["sign"] == "winding");
    CHECK(json["warnings"].empty());
    for (const char* key : {"read", "build", "write"}) CHECK(json["seconds"][key].is_number());
    CHECK(json["verify"]["samples"] > 1000);
    CHECK(json["verify"]["max_error_vx"] < 1e-4);
    CHECK(json["verify"]["rms_error_vx"].is_number());
    CHECK(json["verify"]["sign_errors"] == 0);

    const Json info = Json::parse(runTool("info --json " + (folder / "b.vdb")).out);
    CHECK(info["files"][0]["holds"][0]["name"] == "bunny");
    CHECK(info["files"][0]["holds"][0]["half_width_vx"].get<double>() == Approx(3.0));
    CHECK(info["files"][0]["holds"][0]["verdict"] == "fit to collide with");
}

TEST_CASE("band widths are taken in voxels and in world units")
{
    const TemporaryFolder folder;
    const std::string mesh2ls = "mesh2ls " + sourcePath("data/bunny.obj") + " --voxel 0.2 -o " + (folder / "b.vdb");
    const auto halfWidth = [&](const std::string& options) {
        REQUIRE(runTool(mesh2ls + options).exitCode == 0);
        return Json::parse(runTool("info --json " + (folder / "b.vdb")).out)["files"][0]["holds"][0]["half_width_vx"]
            .get<double>();
    };
    CHECK(halfWidth("") == Approx(3.0));
    CHECK(halfWidth(" --band 5vx") == Approx(5.0));
    CHECK(halfWidth(" --exterior 0.8 --interior 2vx") == Approx(4.0));
    CHECK(halfWidth(" --half") == Approx(3.0).epsilon(1e-3));
}

TEST_CASE("particles go through every format and come out in order")
{
    const TemporaryFolder folder;
    REQUIRE(runTool("emit sphere --center 1,2,3 --radius 2 --particle-radius 0.25 --velocity 1,0,-1 --mass 0.5 -n 500 "
                    "--seed 9 -o " +
                    (folder / "a.csv"))
                .exitCode == 0);
    REQUIRE(runTool("convert " + (folder / "a.csv") + " " + (folder / "b.ply")).exitCode == 0);
    REQUIRE(runTool("convert " + (folder / "b.ply") + " " + (folder / "c.csv")).exitCode == 0);
    CHECK(readFile(folder / "a.csv") == readFile(folder / "c.csv"));
    CHECK(readFile(folder / "a.csv").rfind("x,y,z,vx,vy,vz,radius,mass,id\n", 0) == 0);
    REQUIRE(runTool("convert " + (folder / "a.csv") + " " + (folder / "d.vdb")).exitCode == 0);
    REQUIRE(runTool("convert " + (folder / "d.vdb") + " " + (folder / "e.csv")).exitCode == 0);
    CHECK(lineCount(readFile(folder / "e.csv")) == 501);
    CHECK_THAT(readFile(folder / "e.csv"), Catch::EndsWith(",1,0,-1,0.25,0.5,499\n"));
    const Json info = Json::parse(runTool("info --json " + (folder / "d.vdb")).out);
    CHECK(info["files"][0]["holds"][0]["particles"] == 500);
    CHECK(info["files"][0]["holds"][0]["attributes"] == "position, velocity, radius, mass, id");
}

TEST_CASE("sample answers in input order with distance, gradient and bounds")
{
    const TemporaryFolder folder;
    REQUIRE(runTool("mesh2ls " + sourcePath("data/bunny.obj") + " -o " + (folder / "b.vdb") + " --dim 64").exitCode ==
            0);
    folder.write("at.csv", "x,y,z\n0,3,0\n0,60,0\nnan,0,0\n0,0,0\n");
    REQUIRE(runTool("sample " + (folder / "b.vdb") + " --at " + (folder / "at.csv") + " -o " + (folder / "s.csv"))
                .exitCode == 0);
    std::istringstream lines(readFile(folder / "s.csv"));
    std::string line;
    std::getline(lines, line);
    CHECK(line == "x,y,z,phi,gx,gy,gz,lo,hi");
    std::getline(lines, line);
    CHECK(line.rfind("0,3,0,-", 0) == 0);
    std::getline(lines, line);
    CHECK(line.rfind("0,60,0,49.", 0) == 0);
    std::getline(lines, line);
    CHECK(line.rfind("nan,0,0,nan", 0) == 0);
}

TEST_CASE("sample shows every lookup, gradient and storage")
{
    const TemporaryFolder folder;
    REQUIRE(runTool("mesh2ls " + sourcePath("data/bunny.obj") + " -o " + (folder / "b.vdb") + " --dim 64").exitCode ==
            0);
    REQUIRE(runTool("emit surface " + (folder / "b.vdb") + " --offset 0.5vx -n 5 -o " + (folder / "at.csv")).exitCode ==
            0);
    const std::string command =
        "sample --json " + (folder / "b.vdb") + " --at " + (folder / "at.csv") + " -o " + (folder / "s.csv");
    std::set<std::string> answers;
    for (const char* flags : {"", " --lookup nearest", " --lookup cubic", " --normal analytic", " --storage half",
                              " --lookup cubic --normal analytic --storage fixed8"}) {
        const ToolRun result = runTool(command + flags);
        INFO(flags << ": " << result.err);
        REQUIRE(result.exitCode == 0);
        const double error = Json::parse(result.out)["storage_error_vx"];
        CHECK((error > 0.0) == (std::string(flags).find("storage") != std::string::npos));
        CHECK(error < 0.05);
        answers.insert(readFile(folder / "s.csv"));
    }
    CHECK(answers.size() == 6); // all differ
    CHECK(runTool(command + " --lookup cubik").exitCode == 2);
}

TEST_CASE("bench field prints each figure with its peer's and their ratio")
{
    const TemporaryFolder folder;
    REQUIRE(runTool("mesh2ls " + sourcePath("data/bunny.obj") + " -o " + (folder / "b.vdb") + " --dim 64").exitCode ==
            0);
    const ToolRun result = runTool("bench field " + (folder / "b.vdb") + " --points 20000 --repetitions 1 --json");
    INFO(result.err);
    REQUIRE(result.exitCode == 0);
    const Json json = Json::parse(result.out);
    CHECK_FALSE(json["machine"].get<std::string>().empty());
    REQUIRE(json["cases"].size() > 20);
    const auto named = [&](const std::string& part) {
        for (const Json& one : json["cases"]) {
            if (one["name"].get<std::string>().find(part) != std::string::npos) return one;
        }
        FAIL("no case " << part);
        return Json();
    };
    for (const Json& one : json["cases"]) {
        CHECK(one.contains("unit"));
        if (!one.contains("peer")) continue;
        CHECK(one["ratio"].get<double>() ==
              Approx(one["peer"]["value"].get<double>() / one["value"].get<double>()).epsilon(1e-6));
    }
    // What does not depend on the hour: the peers compute the same, errors keep to their bounds, and the bounds' tree
    // is small and tight.
    CHECK(named("difference of phi to the peers'")["value"] < 1e-5);
    CHECK(named("storage half, largest error")["ratio"] >= 1.0);
    CHECK(named("storage fixed8, largest error")["ratio"] >= 1.0);
    CHECK(named("bounds, memory")["ratio"] >= 10.0);
    CHECK(named("bounds, widest")["ratio"] >= 1.0);
    CHECK(runTool("bench").exitCode == 2);

    // Nothing near zero to put points at.
    const auto nowhere = denseGrid([](const Vec3d&) { return 2.5; }, uniformTransform(1.0), 6);
    writeLevelSet(levelSet(nowhere), folder / "nowhere.vdb");
    const ToolRun refused = runTool("bench field " + (folder / "nowhere.vdb") + " --points 1000");
    CHECK(refused.exitCode == 3);
    CHECK(lineCount(refused.err) == 1);
}

TEST_CASE("info warns of walls as thin as a voxel, and of nothing where there are none")
{
    const TemporaryFolder folder;
    for (double thicknessVx : {0.9, 5.0}) {
        const Phi plate = [=](const Vec3d& p) {
            return std::max(std::abs(p.y() - 0.02) - 0.5 * thicknessVx * 0.1, p.norm() - 1.5);
        };
        writeLevelSet(levelSet(bandGrid(plate, uniformTransform(0.1), 20)), folder / "plate.vdb");
        const ToolRun info = runTool("info " + (folder / "plate.vdb"));
        CHECK(info.exitCode == 0);
        CHECK((info.out.find("warning") != std::string::npos) == (thicknessVx < 1.0));
    }
}

TEST_CASE("bench collide prints what a particle step costs beside its peers'")
{
    const ToolRun result = runTool("bench collide --particles 2000 --repetitions 1 --threads 2 --json");
    INFO(result.err);
    REQUIRE(result.exitCode == 0);
    const Json json = Json::parse(result.out);
    std::map<std::string, double> shares;
    std::size_t withPeer = 0;
    for (const Json& one : json["cases"]) {
        const auto name = one["name"].get<std::string>();
        if (one["unit"] == "%") shares[name] = one["value"];
        if (!one.contains("peer")) continue;
        ++withPeer;
        CHECK(one["value"] > 0.0);
        CHECK(one["ratio"].get<double>() ==
              Approx(one["peer"]["value"].get<double>() / one["value"].get<double>()).epsilon(1e-6));
    }
    CHECK(withPeer >= 4);
    // In the example nothing reaches the sphere; from near above everything does.
    CHECK(shares.at("column above a sphere, 2e3 particles, particle steps without a lookup") == 100.0);
    CHECK(shares.at("column landing on a sphere, 2e3 particles, particle steps with contact") > 0.9);
}

TEST_CASE("a surface is covered with particles")
{
    const TemporaryFolder folder;
    REQUIRE(runTool("mesh2ls " + sourcePath("data/bunny.obj") + " -o " + (folder / "b.vdb") + " --dim 64").exitCode ==
            0);
    REQUIRE(
        runTool("emit surface " + (folder / "b.vdb") + " --offset 1vx -n 300 -o " + (folder / "skin.csv")).exitCode ==
        0);
    REQUIRE(runTool("sample " + (folder / "b.vdb") + " --at " + (folder / "skin.csv") + " -o " + (folder / "s.csv"))
                .exitCode == 0);
    std::istringstream lines(readFile(folder / "s.csv"));
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
        double x, y, z, phi;
        REQUIRE(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &x, &y, &z, &phi) == 4);
        REQUIRE(phi == Approx(9.907325 / 64).epsilon(2e-3));
    }
}

TEST_CASE("info tells what every kind of file holds")
{
    const TemporaryFolder folder;
    CHECK_THAT(runTool("info " + sourcePath("data/bunny.obj")).out,
               Catch::Contains("3,674 triangles") && Catch::Contains("closed"));
    folder.write("a.csv", "x,y,z,vx,vy,vz\n0,0,0,3,0,4\nnan,0,0,0,0,0\n");
    CHECK_THAT(runTool("info " + (folder / "a.csv")).out,
               Catch::Contains("2 particles") && Catch::Contains("fastest 5") && Catch::Contains("1 not finite"));
    folder.write("m.ply",
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
                 "z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    CHECK_THAT(runTool("info " + (folder / "m.ply")).out, Catch::Contains("1 triangles") && Catch::Contains("3 open"));
}
