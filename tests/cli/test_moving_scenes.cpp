// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/run_tool.h"
#include "support/temporary_folder.h"

#include "vdbounce/io/grid_file.h"
#include "vdbounce/io/particle_file.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>

using namespace vdbounce;
using namespace vdbounce::test;
using Json = nlohmann::json;

namespace {

// One particle at rest in no gravity, and a ball of radius 1 whose keys a test adds.
class BallScene : public TemporaryFolder {
public:
    explicit BallScene(const std::string& collider, const std::string& particles = "x,y,z\n0,1.5,0\n",
                       const std::string& more = "")
    {
        writeLevelSet(levelSet(bandGrid(sphere(1.0), uniformTransform(0.05), 28, 5.0)), *this / "ball.vdb");
        write("p.csv", particles);
        write("scene.toml", "[time]\ndt = 0.01\nsteps_per_frame = 10\nframes = 10\n[world]\ngravity = [0,0,0]\n"
                            "[particles]\nfile = \"p.csv\"\n" +
                                more + "[[collider]]\nname = \"ball\"\n" + collider +
                                "\n[output]\nfile = \"o.####.csv\"\nhits = true\n");
    }

    Json run(const std::string& options = "") const
    {
        const ToolRun done = runTool("collide " + (*this / "scene.toml") + " --json " + options);
        INFO(done.err);
        REQUIRE(done.exitCode == 0);
        return Json::parse(done.out);
    }

    Particles frame(int number) const
    {
        char name[16];
        std::snprintf(name, sizeof name, "o.%04d.csv", number);
        return readParticles(*this / name);
    }
};

} // namespace

TEST_CASE("a scene's moving ball pushes what is in its way")
{
    for (const char* motion : {"motion = { velocity = [0,1,0] }",
                               "motion = { keys = [ { time = 0 }, { time = 2, translate = [0,2,0] } ] }"}) {
        const BallScene scene(std::string("file = \"ball.vdb\"\nrestitution = 1\nfriction = 0\n") + motion);
        const Json json = scene.run();
        const Particles last = scene.frame(10);
        INFO(motion);
        CHECK(last.velocity[0].y() == Approx(2.0).epsilon(1e-3));
        CHECK(json["colliders"][0]["impulse"][1] == Approx(-2.0).epsilon(1e-3));
        REQUIRE(last.hits.size() == 1);
        CHECK(last.hits[0].count == 1);
        CHECK(last.hits[0].collider == 0);
        CHECK(last.hits[0].time == Approx(0.5).margin(0.02));
        CHECK(last.hits[0].position.y() == Approx(1.5).margin(0.02));
        CHECK(last.hits[0].normal.y() == Approx(1.0).epsilon(1e-3));
        CHECK(last.hits[0].velocity.norm() == 0.0);
    }
}

TEST_CASE("frames of a moving scene go on where they left off, to the bit")
{
    const BallScene scene("file = \"ball.vdb\"\nmotion = { velocity = [0.3,1,0], angular_velocity = [0,0,2] }",
                          "x,y,z,vx,vy,vz\n0,1.5,0,0,0,0\n0.3,1.3,0.1,-1,0,0\n-0.5,1.2,0,0,0,0\n");
    scene.run();
    const Particles whole = scene.frame(10);
    scene.run("--frames 0-4");
    scene.run("--frames 4-10");
    const Particles parts = scene.frame(10);
    CHECK(parts.position == whole.position);
    CHECK(parts.velocity == whole.velocity);
}

TEST_CASE("a sequence of level sets pushes what its surface passes")
{
    const BallScene scene("sequence = \"grow.####.vdb\"\nrestitution = 0\nfriction = 0");
    for (int frame = 0; frame <= 10; ++frame) {
        char name[16];
        std::snprintf(name, sizeof name, "grow.%04d.vdb", frame);
        writeLevelSet(levelSet(bandGrid(sphere(1.0 + 0.1 * frame), uniformTransform(0.05), 48, 5.0)), scene / name);
    }
    const Json json = scene.run();
    CHECK(json["unresolved"] == 0);
    const Particles last = scene.frame(10);
    // Ten frames of 0.1 s: the radius grows by 1 a second, to 2.
    CHECK(last.position[0].y() == Approx(2.0).margin(0.01));
    CHECK(last.position[0].y() >= 2.0 - 1e-6);
    CHECK(last.velocity[0].y() == Approx(1.0).epsilon(0.02));

    const ToolRun short1 = runTool("collide " + (scene / "scene.toml") + " --set time.frames=11");
    CHECK(short1.exitCode == 3);
    CHECK_THAT(short1.err, Catch::Contains("grow.0011.vdb"));
}

TEST_CASE("a sequence is known to be whole, and its bands wide enough, before it is run into")
{
    const BallScene scene("sequence = \"thin.####.vdb\"", "x,y,z,radius\n0,1.5,0,0.15\n");
    for (int frame = 0; frame <= 10; ++frame) {
        char name[16];
        std::snprintf(name, sizeof name, "thin.%04d.vdb", frame);
        writeLevelSet(levelSet(bandGrid(sphere(1.0), uniformTransform(0.05), 28, frame == 3 ? 2.0 : 5.0)),
                      scene / name);
    }
    const ToolRun thin = runTool("collide " + (scene / "scene.toml"));
    CHECK(thin.exitCode == 3);
    CHECK_THAT(thin.err, Catch::Contains("thin.0003.vdb") && Catch::Contains("too thin"));
    std::filesystem::remove(scene / "thin.0007.vdb");
    std::filesystem::remove(scene / "o.0000.csv");
    const ToolRun missing = runTool("collide " + (scene / "scene.toml"));
    CHECK(missing.exitCode == 3);
    CHECK_THAT(missing.err, Catch::Contains("thin.0007.vdb") && Catch::Contains("0-6"));
    CHECK_FALSE(std::filesystem::exists(scene / "o.0000.csv"));
}

TEST_CASE("what is stuck to a collider that is not there is refused by name")
{
    for (const char* stuck : {"7000000", "1", "-2", "0.5"}) {
        const BallScene scene("file = \"ball.vdb\"\non_hit = \"stick\"",
                              std::string("x,y,z,stuck,id\n0,1.5,0,") + stuck + ",42\n");
        const ToolRun run = runTool("collide " + (scene / "scene.toml"));
        INFO(stuck << ": " << run.err);
        if (stuck == std::string("0.5")) {
            CHECK(run.exitCode == 0); // no collider: -1
        } else {
            CHECK(run.exitCode == 3);
            CHECK_THAT(run.err, Catch::Contains("p.csv") && Catch::Contains("particle 42"));
        }
    }
}

TEST_CASE("what sticks to something that recedes sticks to it, not to where it was")
{
    const BallScene scene("file = \"ball.vdb\"\non_hit = \"stick\"\nmotion = { velocity = [0,-5,0] }",
                          "x,y,z,vx,vy,vz\n0,1.5,0,0,-10,0\n", "[contact]\nsweep = \"always\"\n");
    scene.run("--set time.frames=3");
    const Particles last = scene.frame(3);
    REQUIRE(last.stuckTo[0] == 0);
    CHECK((last.position[0] - Vec3d(0, -1.5, 0)).norm() == Approx(1.0).margin(0.005));
}

TEST_CASE("a grid of velocities in a sequence's files is the velocity of its surface")
{
    const BallScene scene("sequence = \"turn.####.vdb\"\nrestitution = 0\nfriction = 5",
                          "x,y,z,vx,vy,vz\n0,1.5,0,0,-2,0\n");
    const auto ball = bandGrid(sphere(1.0), uniformTransform(0.05), 28, 5.0);
    ball->setName("surface");
    auto velocity = openvdb::Vec3SGrid::create(openvdb::Vec3f(0.0f, 0.0f, 0.75f));
    velocity->setTransform(uniformTransform(0.1));
    velocity->setName("v");
    for (int frame = 0; frame <= 10; ++frame) {
        char name[16];
        std::snprintf(name, sizeof name, "turn.%04d.vdb", frame);
        openvdb::io::File(scene / name).write(openvdb::GridCPtrVec{ball, velocity});
    }
    scene.run();
    const Particles last = scene.frame(10);
    // The ball keeps its form, but its surface is dragged along z, and with it what lies on it.
    CHECK(last.velocity[0].z() == Approx(0.75).epsilon(1e-3));
    CHECK(last.velocity[0].head<2>().norm() < 0.02);
}

TEST_CASE("what sticks rides along, what is deleted is gone, and both are in the files")
{
    const std::string two = "x,y,z,vx,vy,vz\n0,1.5,0,0,-2,0\n5,5,5,0,0,0\n";
    {
        const BallScene scene("file = \"ball.vdb\"\non_hit = \"stick\"\nmotion = { velocity = [1,0,0] }", two);
        scene.run();
        const Particles last = scene.frame(10);
        REQUIRE(last.stuckTo == std::vector<std::int32_t>{0, -1});
        CHECK(last.velocity[0].x() == Approx(1.0));
        // Relative to the ball it stays where it touched.
        const Particles before = scene.frame(9);
        CHECK((last.position[0] - before.position[0] - Vec3d(0.1, 0, 0)).norm() < 1e-12);
        CHECK((last.position[0] - Vec3d(1, 0, 0)).norm() == Approx(1.0).margin(1e-3));
        // And goes on to do so from a file.
        scene.run("--frames 0-6");
        scene.run("--frames 6-10");
        CHECK((scene.frame(10).position[0] - last.position[0]).norm() < 1e-14);
    }
    const BallScene scene("file = \"ball.vdb\"\non_hit = \"delete\"", two);
    const Json json = scene.run();
    CHECK(json["deleted"] == 1);
    CHECK(json["particles"] == 2);
    const Particles last = scene.frame(10);
    REQUIRE(last.size() == 1);
    CHECK(last.id[0] == 1);
}

TEST_CASE("a ball with a mass is pushed by particles and takes their momentum")
{
    const BallScene scene("file = \"ball.vdb\"\nmass = 3\nrestitution = 1\nfriction = 0",
                          "x,y,z,vx,vy,vz,mass\n0,1.5,0,0,-2,0,1\n");
    const Json json = scene.run();
    const Particles last = scene.frame(10);
    // Elastic, head-on, masses 1 and 3: the particle goes back at half its speed.
    CHECK(last.velocity[0].y() == Approx(1.0).epsilon(1e-3));
    CHECK(json["colliders"][0]["impulse"][1] == Approx(-3.0).epsilon(1e-3));
    const ToolRun later = runTool("collide " + (scene / "scene.toml") + " --frames 4-10");
    CHECK(later.exitCode == 2);
    CHECK_THAT(later.err, Catch::Contains("has a mass"));
}

TEST_CASE("particles collide with each other on request, and repulsion keeps them off")
{
    const std::string meeting = "x,y,z,vx,vy,vz,radius\n-3,5,0,1,0,0,0.1\n-2.5,5,0,-1,0,0,0.1\n";
    for (bool interact : {false, true}) {
        const BallScene scene("file = \"ball.vdb\"", meeting, interact ? "interact = true\nrestitution = 1\n" : "");
        scene.run();
        CHECK(scene.frame(10).velocity[0].x() == Approx(interact ? -1.0 : 1.0));
    }
    const BallScene scene("file = \"ball.vdb\"\nfriction = 0", "x,y,z,vx,vy,vz\n0,1.5,0,0,-0.3,0\n",
                          "[contact]\nrepulsion = { range = \"2vx\", strength = 50 }\n");
    const Json json = scene.run("--set time.frames=40");
    CHECK(json["contacts"] == 0);
    CHECK(scene.frame(40).velocity[0].y() > 0.0);
    const ToolRun far = runTool("collide " + (scene / "scene.toml") + " --set contact.repulsion.range=0.3");
    CHECK(far.exitCode == 3);
    CHECK_THAT(far.err, Catch::Contains("repulsion") && Catch::Contains("--exterior"));
}
