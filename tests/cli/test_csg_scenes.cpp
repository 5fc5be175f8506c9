// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/run_tool.h"
#include "support/temporary_folder.h"

#include "vdbounce/io/grid_file.h"
#include "vdbounce/io/particle_file.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace vdbounce;
using namespace vdbounce::test;
using Json = nlohmann::json;

namespace {

// A few particles over the origin, and the colliders that a test adds.
class ShapeScene : public TemporaryFolder {
public:
    explicit ShapeScene(const std::string& colliders, const std::string& particles = "x,y,z\n0,1,0\n")
    {
        writeLevelSet(levelSet(bandGrid(sphere(0.5), uniformTransform(0.05), 16, 5.0)), *this / "ball.vdb");
        write("p.csv", particles);
        write("scene.toml", "[time]\ndt = 0.004\nsteps_per_frame = 25\nframes = 10\n[particles]\nfile = \"p.csv\"\n"
                            "radius = 0.05\n" +
                                colliders + "\n[output]\nfile = \"o.csv\"\n");
    }

    ToolRun run(const std::string& options = "--json") const
    {
        return runTool("collide " + (*this / "scene.toml") + " " + options);
    }

    Particles last() const { return readParticles(*this / "o.csv"); }
};

} // namespace

TEST_CASE("a scene's shapes by formula stop what falls on them")
{
    const std::pair<const char*, double> shapes[] = {
        {"sphere = { center = [0,-0.5,0], radius = 0.5 }", 0.0},
        {"box = { center = [0,-0.5,0], half = [1,0.5,1], rotate = [0.9238795, 0, 0.3826834, 0] }", 0.0},
        {"capsule = { from = [-1,-0.5,0], to = [1,-0.5,0], radius = 0.5 }", 0.0},
        {"cylinder = { from = [0,-1,0], to = [0,0.1,0], radius = 0.5 }", 0.1},
        {"cone = { from = [0,-1,0], to = [0,0,0], radius = 0.5, top_radius = 0.2 }", 0.0},
        {"torus = { center = [0,0,0], axis = [1,0,0], major = 0.5, minor = 0.2 }", 0.7},
        {"ellipsoid = { center = [0,-0.5,0], radii = [1,0.5,1] }", 0.0},
        {"heightfield = { file = \"map.txt\", min = [-1,0.3,-1], max = [1,1,1] }", 0.3},
        {"blobs = { file = \"goo.csv\", voxel = 0.05, kernel = \"sphere\", band = \"5vx\" }", 0.0},
        {"plane = { point = [0,0.2,0], normal = [0,1,0] }", 0.2}};
    for (const auto& [shape, top] : shapes) {
        const ShapeScene scene(std::string("[[collider]]\nrestitution = 0\n") + shape);
        scene.write("map.txt", "0 0 0\n0 0 0\n");
        scene.write("goo.csv", "x,y,z,radius\n0,-0.5,0,0.5\n");
        const ToolRun done = scene.run();
        INFO(shape << ": " << done.err);
        REQUIRE(done.exitCode == 0);
        CHECK(Json::parse(done.out)["contacts"] > 0);
        CHECK(scene.last().position[0].y() == Approx(top + 0.05).margin(2e-3));
    }
}

TEST_CASE("a scene combines its colliders by CSG, and what it combines no longer collides itself")
{
    // A slab with a shaft, down to a floor: beside the shaft it stays on the slab.
    const ShapeScene scene(
        "[[collider]]\nname = \"slab\"\nbox = { half = [2,0.3,2] }\n"
        "[[collider]]\nname = \"shaft\"\ncylinder = { from = [0,-1,0], to = [0,1,0], radius = 0.2 }\n"
        "[[collider]]\nname = \"well\"\nrestitution = 0\n"
        "csg = { op = \"subtract\", of = [\"slab\", \"shaft\"] }\n"
        "[[collider]]\nname = \"floor\"\nrestitution = 0\nplane = { point = [0,-1,0] }\n",
        "x,y,z\n0,1,0\n1,1,0\n");
    const ToolRun done = scene.run();
    INFO(done.err);
    REQUIRE(done.exitCode == 0);
    const Json json = Json::parse(done.out);
    REQUIRE(json["colliders"].size() == 2);
    CHECK(json["colliders"][0]["name"] == "well");
    CHECK(scene.last().position[0].y() == Approx(-0.95).margin(2e-3));
    CHECK(scene.last().position[1].y() == Approx(0.35).margin(2e-3));
    const ToolRun plan = scene.run("--explain");
    CHECK(plan.out.find("csg subtraction of 'slab', 'shaft'") != std::string::npos);
    CHECK(plan.out.find("along every path") != std::string::npos); // what is cut has no least thickness
}

TEST_CASE("CSG takes level sets and moving colliders")
{
    // The ball of a level set is taken out of a block that stands, while the ball rises: what lay on the block falls
    // in.
    const ShapeScene scene(
        "[[collider]]\nname = \"block\"\nbox = { center = [0,-1,0], half = [2,1,2] }\n"
        "[[collider]]\nname = \"ball\"\nfile = \"ball.vdb\"\nmotion = { velocity = [0,0,0] }\n"
        "[[collider]]\nname = \"hollow\"\nrestitution = 0\ncsg = { op = \"subtract\", of = [\"block\", \"ball\"] }\n",
        "x,y,z\n0,1,0\n1,1,0\n");
    const ToolRun done = scene.run();
    INFO(done.err);
    REQUIRE(done.exitCode == 0);
    CHECK(scene.last().position[0].y() == Approx(-0.45).margin(5e-3));
    CHECK(scene.last().position[1].y() == Approx(0.05).margin(2e-3));

    const ShapeScene moving(
        "[[collider]]\nname = \"block\"\nbox = { center = [0,-1,0], half = [2,1,2] }\n"
        "[[collider]]\nname = \"ball\"\nfile = \"ball.vdb\"\n"
        "motion = { keys = [{ time = 0, translate = [-1.2,0,0] }, { time = 0.6, translate = [-1.2,0,0] }, "
        "{ time = 0.8, translate = [0,0,0] }] }\n"
        "[[collider]]\nname = \"hollow\"\nrestitution = 0\ncsg = { op = \"subtract\", of = [\"block\", \"ball\"] }\n");
    REQUIRE(moving.run().exitCode == 0);
    CHECK(moving.last().position[0].y() < -0.2);
}

TEST_CASE("a scene's faults in shapes and CSG are refused by line and name")
{
    struct Fault {
        const char* colliders;
        const char* message;
    };
    const Fault faults[] = {
        {"[[collider]]\nsphere = { center = [0,0,0], radius = -1 }",
         "scene.toml:9: collider 'collider0'.sphere.radius"},
        {"[[collider]]\nsphere = { center = [0,0,0] }", "radius is missing"},
        {"[[collider]]\nsphere = { radius = 1, colour = 3 }", "unknown key"},
        {"[[collider]]\nsphere = { radius = 1 }\nfile = \"ball.vdb\"", "exactly one is needed"},
        {"[[collider]]\nname = \"a\"", "exactly one is needed"},
        {"[[collider]]\nname = \"a\"\ncsg = { op = \"union\", of = [\"b\", \"c\"] }", "'b', which is no collider"},
        {"[[collider]]\nname = \"a\"\ncsg = { op = \"union\", of = [\"a\", \"a\"] }", "'a', which is made of it"},
        {"[[collider]]\nname = \"a\"\ncsg = { op = \"melt\", of = [\"a\", \"a\"] }", "use one of: union"},
        {"[[collider]]\nname = \"a\"\ncsg = { op = \"complement\", of = [\"b\", \"c\"] }", "complement takes one"},
        {"[[collider]]\nname = \"b\"\nsphere = { radius = 1 }\nfriction = 0.2\n[[collider]]\nname = \"a\"\ncsg = { op "
         "= "
         "\"complement\", of = [\"b\"] }",
         "friction is set, and collider 'a' is made of it"},
        {"[[collider]]\nname = \"b\"\nsphere = { radius = 1 }\n[[collider]]\nname = \"a\"\ncsg = { op = \"union\", of "
         "= "
         "[\"b\", \"b\"], blend = \"2vx\" }",
         "is in voxels"},
        {"[[collider]]\nname = \"b\"\nsphere = { radius = 1 }\n[[collider]]\nname = \"a\"\ncsg = { op = \"union\", of "
         "= "
         "[\"b\", \"b\"], blend = -1 }",
         "csg.blend = -1"}};
    for (const Fault& fault : faults) {
        const ToolRun done = ShapeScene(fault.colliders).run();
        INFO(fault.colliders << "\n" << done.err);
        CHECK((done.exitCode == 3 || done.exitCode == 2));
        CHECK(lineCount(done.err) == 1);
        CHECK(done.err.find(fault.message) != std::string::npos);
    }
}
