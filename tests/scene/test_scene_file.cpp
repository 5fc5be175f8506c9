// SPDX-License-Identifier: Apache-2.0
#include "support/temporary_folder.h"

#include "vdbounce/base/error.h"
#include "vdbounce/scene/scene_file.h"

#include <catch2/catch.hpp>

using namespace vdbounce;
using test::TemporaryFolder;

namespace {

const std::string kParticles = "[particles]\nfile = \"cloud.vdb\"\n";

} // namespace

TEST_CASE("a scene that leaves everything out has the documented defaults")
{
    const TemporaryFolder folder;
    const Scene scene = readScene(folder.write("a.toml", kParticles));
    CHECK(scene.particleFile == folder / "cloud.vdb");
    CHECK(scene.dt == 0.004);
    CHECK(scene.stepsPerFrame == 10);
    CHECK(scene.frames == 48);
    CHECK(scene.gravity == Vec3d(0, -9.81, 0));
    CHECK(scene.radius.value == 0.0);
    CHECK(scene.maxBounces == 3);
    CHECK(scene.sweep == Sweep::Auto);
    CHECK(scene.colliders.empty());
    CHECK(scene.outputFile.empty());
}

TEST_CASE("every key of the contract is read")
{
    const TemporaryFolder folder;
    const Scene scene = readScene(folder.write("a.toml", R"(
[time]
dt = 0.01
steps_per_frame = 5
frames = 7
[world]
gravity = [0, 0, -1]
[particles]
file = "/abs/cloud.csv"
radius = "2vx"
mass = 3
interact = false
[contact]
scheme = "collide-contact"
max_bounces = 1
sweep = "never"
repulsion = { range = 0.0, strength = 0.0 }
[accuracy]
lookup = "cubic"
normal = "analytic"
storage = "half"
[[collider]]
name = "bunny"
file = "meshes/bunny.vdb"
restitution = 0.1
friction = 2
on_hit = "bounce"
[[collider]]
plane = { point = [0, 1, 0], normal = [0, 2, 0] }
[output]
file = "out.####.vdb"
every = 2
)"));
    CHECK(scene.dt == 0.01);
    CHECK(scene.particleFile == "/abs/cloud.csv");
    CHECK(scene.radius.inVoxels);
    CHECK(scene.mass == 3.0);
    CHECK(scene.sweep == Sweep::Never);
    CHECK(scene.accuracy.lookup == Lookup::Cubic);
    CHECK(scene.accuracy.normal == Normal::Analytic);
    CHECK(scene.accuracy.storage == Storage::Half);
    REQUIRE(scene.colliders.size() == 2);
    CHECK(scene.colliders[0].file == folder / "meshes/bunny.vdb");
    CHECK(scene.colliders[0].friction == 2.0);
    CHECK(scene.colliders[1].name == "collider1");
    CHECK(std::get<PlaneShape>(*scene.colliders[1].formula).normal == Vec3d(0, 2, 0));
    CHECK(scene.outputFile == folder / "out.####.vdb");
    CHECK(scene.every == 2);
}

TEST_CASE("a wrong scene is refused by name and line")
{
    struct Case {
        const char* text;
        const char* place;
        const char* what;
    };
    const Case cases[] = {
        {"[time]\ndt = 0.01\nsteps = 5\n", ":3", "unknown key 'time.steps'"},
        {"[tiem]\n", ":1", "unknown key 'tiem'"},
        {"[time]\ndt = \"fast\"\n", ":2", "time.dt = 'fast' is not a number"},
        {"[time]\n\ndt = -1.0\n", ":3", "time.dt = -1 is out of range"},
        {"[time]\nframes = 1.5\n", ":2", "whole number"},
        {"[world]\ngravity = [0, 1]\n", ":2", "three numbers"},
        {"[contact]\nscheme = \"bounce\"\n", ":2", "use one of: once, iterate, collide-contact"},
        {"[[collider]]\nfile = \"a.vdb\"\nrestitution = 1.5\n", ":3", "collider[0].restitution = 1.5 is out of range"},
        {"[[collider]]\nname = \"a\"\nfile = \"a.vdb\"\nfrictoin = 1\n", ":4", "unknown key 'collider 'a'.frictoin'"},
        {"[[collider]]\nname = \"a\"\n", ":1", "exactly one"},
        {"[[collider]]\nname = \"a\"\nfile = \"a.vdb\"\n[[collider]]\nname = \"a\"\nfile = \"b.vdb\"\n", ":4",
         "two colliders are called 'a'"},
        {"[[collider]]\nplane = { point = [0,0,0], normal = [0,0,0] }\n", ":2", "normal"},
        {"[[collider]]\nfile = \"a.vdb\"\nmotion = { speed = [1,0,0] }\n", ":3", "unknown key"},
        {"[[collider]]\nfile = \"a.vdb\"\nmotion = { keys = [] }\n", ":3", "is empty"},
        {"[[collider]]\nfile = \"a.vdb\"\nmotion = { keys = [ { translate = [0,0,0] } ] }\n", ":3", "time is missing"},
        {"[[collider]]\nfile = \"a.vdb\"\nmotion = { keys = [ { time = 1 }, { time = 1 } ] }\n", ":3",
         "not after the key before"},
        {"[[collider]]\nfile = \"a.vdb\"\nmotion = { keys = [ { time = 1, rotate = [0,0,0,0] } ] }\n", ":3",
         "no rotation"},
        {"[[collider]]\nsequence = \"a.vdb\"\n", ":2", "no ####"},
        {"[[collider]]\nsequence = \"a.##.vdb\"\nfile = \"a.vdb\"\n", ":3", "exactly one"},
        {"[[collider]]\nfile = \"a.vdb\"\nmass = 0\n", ":3", "mass = 0 is out of range"},
        {"[[collider]]\nfile = \"a.vdb\"\nmass = 1\ncenter_of_mass = [nan,0,0]\n", ":4", "out of range"},
        {"[[collider]]\nplane = {}\nmass = 1\n", ":3", "endless"},
        {"[[collider]]\nfile = \"a.vdb\"\nmass = 1\nmotion = { keys = [ { time = 0 } ] }\n", ":3", "either"},
        {"[[collider]]\nfile = \"a.vdb\"\non_hit = \"explode\"\n", ":3", "not a choice"},
        {"[contact]\nscheme = \"twice\"\n", ":2", "not a choice"},
        {"[contact]\nrepulsion = { range = -1 }\n", ":2", "out of range"},
        {"[output]\nevery = 0\n", ":2", "output.every = 0"},
        {"[time\n", ":1", "is no TOML"},
        {"[time]\ndt = 1\ndt = 2\n", ":3", "is no TOML"},
        {"[collider]\nfile = \"a.vdb\"\n", ":1", "double brackets"},
    };
    const TemporaryFolder folder;
    for (const Case& c : cases) {
        INFO(c.text);
        const std::string path = folder.write("a.toml", std::string(c.text) + kParticles);
        CHECK_THROWS_AS(readScene(path), InputError);
        CHECK_THROWS_WITH(readScene(path), Catch::Contains(path + c.place) && Catch::Contains(c.what));
    }
    CHECK_THROWS_WITH(readScene(folder.write("a.toml", "[time]\ndt = 1\n")),
                      Catch::Contains("particles.file is missing"));
    CHECK_THROWS_AS(readScene(folder / "missing.toml"), InputError);
}

TEST_CASE("single keys can be set from outside")
{
    const TemporaryFolder folder;
    const std::string path = folder.write("a.toml", kParticles + "[[collider]]\nname = \"bunny\"\nfile = \"a.vdb\"\n");
    const Scene scene = readScene(path, {"time.dt=0.5", "collider.bunny.friction=0.25", "collider.0.restitution=1",
                                         "contact.sweep=always", "output.file=x.csv"});
    CHECK(scene.dt == 0.5);
    CHECK(scene.colliders[0].friction == 0.25);
    CHECK(scene.colliders[0].restitution == 1.0);
    CHECK(scene.sweep == Sweep::Always);
    CHECK(scene.outputFile == folder / "x.csv");
    CHECK_THROWS_AS(readScene(path, {"time.dt"}), UsageError);
    CHECK_THROWS_AS(readScene(path, {"collider.dog.friction=1"}), UsageError);
    CHECK_THROWS_WITH(readScene(path, {"time.td=1"}), Catch::Contains("unknown key 'time.td'"));
    CHECK_THROWS_WITH(readScene(path, {"time.dt=-1"}), Catch::Contains("out of range"));
}

TEST_CASE("frame numbers fill the run of #")
{
    CHECK(framePath("out.####.vdb", 7) == "out.0007.vdb");
    CHECK(framePath("out.##.vdb", 1234) == "out.1234.vdb");
    CHECK(framePath("a#/out.###.vdb", 5) == "a#/out.005.vdb");
    CHECK(framePath("out.vdb", 7) == "out.vdb");
    CHECK(framePath("take#2/out.vdb", 7) == "take#2/out.vdb");
    CHECK_FALSE(hasFramePattern("take#2/out.vdb"));
}
