// SPDX-License-Identifier: Apache-2.0
#include "support/run_tool.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace vdbounce::test;
using Json = nlohmann::json;

namespace {

// A folder with a bunny, a cloud above it and a scene.
class Prepared : public TemporaryFolder {
public:
    explicit Prepared(const std::string& cloud = "cloud.vdb")
    {
        REQUIRE(runTool("mesh2ls " + sourcePath("data/bunny.obj") + " -o " + (*this / "bunny.vdb") + " --dim 64")
                    .exitCode == 0);
        REQUIRE(runTool("emit box --min -3,9.8,-2 --max 3,12,2 -n 20000 -o " + (*this / cloud)).exitCode == 0);
        write("scene.toml",
              "[time]\nframes = 12\n[particles]\nfile = \"" + cloud +
                  "\"\nradius = 0.02\n[[collider]]\nname = \"bunny\"\nfile = \"bunny.vdb\"\n[[collider]]\nname = "
                  "\"floor\"\n"
                  "plane = { point = [0,0,0], normal = [0,1,0] }\n[output]\nfile = \"out.####.vdb\"\nevery = 6\n");
    }
};

} // namespace

TEST_CASE("a scene runs from the particle file to its last frame")
{
    const Prepared folder;
    const ToolRun run = runTool("collide " + (folder / "scene.toml") + " --json");
    INFO(run.err);
    REQUIRE(run.exitCode == 0);
    CHECK(run.err.empty()); // no progress in a pipe
    const Json json = Json::parse(run.out);
    for (const char* key :
         {"particles", "frames", "steps", "seconds", "particle_steps_per_second", "free", "near", "contacts", "swept",
          "unresolved", "rejected", "deleted", "max_penetration", "energy_initial", "energy_final"}) {
        INFO(key);
        CHECK(json.at(key).is_number());
    }
    CHECK(json["particles"] == 20000);
    CHECK(json["frames"] == 12);
    CHECK(json["steps"] == 120);
    CHECK(json["free"].get<long>() + json["near"].get<long>() == 20000 * 120);
    CHECK(json["contacts"] > 0);
    CHECK(json["rejected"] == 0);
    CHECK(json["energy_final"] < json["energy_initial"]);
    REQUIRE(json["colliders"].size() == 2);
    CHECK(json["colliders"][0]["name"] == "bunny");
    CHECK(json["colliders"][0]["impulse"].size() == 3);
    CHECK(json["colliders"][0]["impulse"][1] < 0.0);
    CHECK(json["colliders"][0]["angular_impulse"].size() == 3);
    for (const char* name : {"out.0000.vdb", "out.0006.vdb", "out.0012.vdb"})
        CHECK(std::filesystem::exists(folder / name));
    CHECK(folder.fileCount() == 6);
}

TEST_CASE("one and two threads write identical files")
{
    const Prepared folder;
    for (const char* threads : {"1", "2"}) {
        const std::string out = std::string("--set output.file=t") + threads + ".####.vdb";
        REQUIRE(runTool("collide " + (folder / "scene.toml") + " " + out + " --threads " + threads).exitCode == 0);
    }
    for (const char* frame : {"0000", "0006", "0012"}) {
        const std::string one = readFile(folder / (std::string("t1.") + frame + ".vdb"));
        REQUIRE(one.size() > 1000);
        CHECK(one == readFile(folder / (std::string("t2.") + frame + ".vdb")));
    }
}

TEST_CASE("a run can go on from a frame that it wrote")
{
    const Prepared folder("cloud.csv");
    const std::string scene = "collide " + (folder / "scene.toml");
    REQUIRE(runTool(scene + " --set output.file=whole.####.csv").exitCode == 0);
    REQUIRE(runTool(scene + " --set output.file=part.####.csv --frames 0-6").exitCode == 0);
    REQUIRE(runTool(scene + " --set output.file=part.####.csv --frames 6-12").exitCode == 0);
    CHECK(readFile(folder / "whole.0012.csv") == readFile(folder / "part.0012.csv"));
    CHECK(runTool(scene + " --set output.file=none.####.csv --frames 6-12").exitCode == 3);
    CHECK(runTool(scene + " --frames 12-6").exitCode == 2);
}

TEST_CASE("frame 0 is the input as read")
{
    const Prepared folder("cloud.csv");
    REQUIRE(runTool("collide " + (folder / "scene.toml") + " --set output.file=out.####.csv --set time.frames=0")
                .exitCode == 0);
    const std::string in = readFile(folder / "cloud.csv");
    const std::string out = readFile(folder / "out.0000.csv");
    CHECK(lineCount(in) == lineCount(out));
    CHECK(in.substr(in.find('\n') + 1, 30) == out.substr(out.find('\n') + 1, 30));
}

TEST_CASE("the quick form needs no scene")
{
    const Prepared folder;
    const std::string quick =
        "collide --collider " + (folder / "bunny.vdb") + " --particles " + (folder / "cloud.vdb") +
        " --dt 0.01 --steps 20 --gravity 0,-9.81,0 --restitution 0.2 --friction 0.4 --radius 0.5vx";
    const ToolRun run = runTool(quick + " --json -o " + (folder / "after.csv"));
    INFO(run.err);
    REQUIRE(run.exitCode == 0);
    CHECK(Json::parse(run.out)["steps"] == 20);
    CHECK(lineCount(readFile(folder / "after.csv")) == 20001);
    REQUIRE(runTool(quick + " -o " + (folder / "step.##.ply")).exitCode == 0);
    CHECK(std::filesystem::exists(folder / "step.20.ply"));
    CHECK(runTool("collide --collider x.vdb -o y.csv").exitCode == 2);
    CHECK(runTool("collide " + (folder / "scene.toml") + " --dt 1").exitCode == 2);
}

TEST_CASE("the plan is explained without running anything")
{
    const Prepared folder;
    const ToolRun run = runTool("collide " + (folder / "scene.toml") + " --explain");
    CHECK(run.exitCode == 0);
    CHECK_THAT(run.out, Catch::Contains("collider 'bunny': level set") && Catch::Contains("sweep") &&
                            Catch::Contains("left out"));
    CHECK(folder.fileCount() == 3);
}

TEST_CASE("the plan tells what steps, memory and band it takes, and what it leaves out")
{
    const Prepared folder;
    const auto explain = [&](const std::string& settings) {
        const ToolRun run = runTool("collide " + (folder / "scene.toml") + " --explain --json" + settings);
        INFO(run.err);
        REQUIRE(run.exitCode == 0);
        return Json::parse(run.out);
    };
    const Json plan = explain("");
    const ToolRun done = runTool("collide " + (folder / "scene.toml") + " --json");
    REQUIRE(done.exitCode == 0);
    const Json run = Json::parse(done.out);
    CHECK(plan["particles"] == run["particles"]);
    CHECK(plan["steps"] == run["steps"]);
    // The shares of a part of the particles are about those of all; times are not compared.
    const double all = plan["trial"]["free"].get<double>() + plan["trial"]["near"].get<double>();
    const double steps = run["particle_steps_per_second"].get<double>() * run["seconds"].get<double>();
    CHECK(plan["trial"]["free"].get<double>() / all == Approx(run["free"].get<double>() / steps).margin(0.1));
    CHECK(plan["expected_seconds"] > 0.0);
    CHECK(plan["expected_bytes"] > 20000 * 60);
    const std::string text = plan["plan"].dump();
    CHECK_THAT(text, Catch::Contains("is needed") && Catch::Contains("expected: "));
    CHECK_THAT(text, Catch::Contains("left out: collider velocities (none moves)"));
    CHECK_THAT(explain(" --set particles.radius=0.0")["plan"].dump(), Catch::Contains("radii (particles are points)"));
    CHECK(explain(" --set particles.interact=true")["expected_seconds"].is_null());
    const ToolRun thin = runTool("collide " + (folder / "scene.toml") + " --explain --set particles.radius=3.0");
    CHECK(thin.exitCode == 3);
    CHECK(lineCount(thin.err) == 1);
    CHECK_FALSE(explain("").contains("chosen"));
    CHECK(explain(" --max-error 0.4vx")["chosen"]["storage"] == "float");
}

TEST_CASE("a scene's accuracy decides how its level sets are looked up")
{
    const Prepared folder;
    const std::string scene = "collide " + (folder / "scene.toml") + " --set output.file=o.csv";
    const auto run = [&](const std::string& settings) {
        const ToolRun done = runTool(scene + settings + " --json");
        INFO(settings << ": " << done.err);
        REQUIRE(done.exitCode == 0);
        return Json::parse(done.out);
    };
    const Json usual = run("");
    const std::string particles = readFile(folder / "o.csv");
    run(" --set accuracy.lookup=trilinear --set accuracy.normal=central --set accuracy.storage=float");
    CHECK(readFile(folder / "o.csv") == particles);
    for (const char* other : {"lookup=nearest", "lookup=cubic", "normal=analytic", "storage=half", "storage=fixed8"}) {
        INFO(other);
        const Json json = run(std::string(" --set accuracy.") + other);
        CHECK(readFile(folder / "o.csv") != particles);
        // The same fall, to the accuracy of a bunny of 64 voxels.
        CHECK(json["contacts"] > 0); // many more with "nearest", whose phi jumps under what slides
        CHECK(json["energy_final"].get<double>() == Approx(usual["energy_final"].get<double>()).epsilon(0.02));
        CHECK(json["max_penetration"].get<double>() < 1e-3);
    }
    const ToolRun plan = runTool(scene + " --explain --set accuracy.lookup=cubic");
    CHECK_THAT(plan.out, Catch::Contains("accuracy: cubic lookup, central normals, values kept as float"));
    const ToolRun wrong = runTool(scene + " --set accuracy.lookup=quintic");
    CHECK(wrong.exitCode == 3);
    CHECK_THAT(wrong.err, Catch::Contains("use one of: nearest, trilinear, cubic"));
}

TEST_CASE("particles that cannot be stepped are kept and counted, and refused when strict")
{
    const Prepared folder("cloud.csv");
    folder.write("bad.csv", "x,y,z,radius,mass\n0,20,0,0.1,1\nnan,0,0,0.1,1\n1,20,0,-1,1\n2,20,0,0.1,-1\n");
    const std::string scene = "collide " + (folder / "scene.toml") +
                              " --set particles.file=bad.csv --set output.file=o.####.csv --set time.frames=1";
    const ToolRun run = runTool(scene + " --json");
    REQUIRE(run.exitCode == 0);
    CHECK(Json::parse(run.out)["rejected"] == 3);
    CHECK_THAT(readFile(folder / "o.0001.csv"), Catch::Contains("\nnan,0,0,0,0,0,0.1,1,1,1\n"));
    CHECK(runTool(scene + " --strict").exitCode == 3);
}

TEST_CASE("a radius beyond the band is refused with the band that would do")
{
    const Prepared folder;
    const ToolRun run = runTool("collide " + (folder / "scene.toml") + " --set particles.radius=0.9");
    CHECK(run.exitCode == 3);
    CHECK_THAT(run.err,
               Catch::Contains("bunny.vdb") && Catch::Contains("too thin") && Catch::Contains("--exterior 8vx"));
    CHECK(folder.fileCount() == 3);
}
