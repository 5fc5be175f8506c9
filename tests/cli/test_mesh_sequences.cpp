// SPDX-License-Identifier: Apache-2.0
#include "support/meshes.h"
#include "support/run_tool.h"
#include "support/temporary_folder.h"

#include "vdbounce/io/particle_file.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <iomanip>

using namespace vdbounce;
using namespace vdbounce::test;
using Json = nlohmann::json;

namespace {

constexpr double kVoxel = 0.1;

std::string numbered(const std::string& before, int frame, const std::string& after)
{
    std::ostringstream name;
    name << before << std::setw(4) << std::setfill('0') << frame << after;
    return name.str();
}

std::string objOf(const TriangleMesh& mesh)
{
    std::ostringstream out;
    out.precision(17);
    for (const Vec3d& p : mesh.points) out << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    for (const auto& t : mesh.triangles) out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
    return out.str();
}

// A ball of radius 1 that moves along z by `step` a frame.
void writeFrames(const TemporaryFolder& folder, int first, int last, double step)
{
    for (int frame = first; frame <= last; ++frame)
        folder.write(numbered("ball.", frame, ".obj"), objOf(sphereMesh(1.0, 3, Vec3d(0, 0, step * frame))));
}

ToolRun convertFrames(const TemporaryFolder& folder, const std::string& options)
{
    return runTool("mesh2ls " + (folder / "ball.####.obj") + " -o " + (folder / "ball.####.vdb") + " " + options);
}

} // namespace

TEST_CASE("a sequence of meshes becomes the level sets that each of them becomes")
{
    const TemporaryFolder folder;
    writeFrames(folder, 7, 9, 0.05);
    folder.write("ball.8.obj", "not of the sequence");
    const ToolRun run = convertFrames(folder, "--dim 20 --json");
    INFO(run.err);
    REQUIRE(run.exitCode == 0);
    const Json json = Json::parse(run.out);
    REQUIRE(json["frames"].size() == 3);
    CHECK(json["triangles"] == 512);
    double seconds = 0.0;
    for (int frame = 7; frame <= 9; ++frame) {
        const Json& one = json["frames"][std::size_t(frame - 7)];
        CHECK(one["frame"] == frame);
        CHECK(one["voxel_size"] == json["frames"][0]["voxel_size"]);
        seconds += one["seconds"]["build"].get<double>();
        const std::string single = folder / "single.vdb";
        std::ostringstream voxel;
        voxel << std::setprecision(17) << one["voxel_size"].get<double>();
        REQUIRE(runTool("mesh2ls " + (folder / numbered("ball.", frame, ".obj")) + " -o " + single + " --voxel " +
                        voxel.str())
                    .exitCode == 0);
        CHECK(readFile(folder / numbered("ball.", frame, ".vdb")) == readFile(single));
    }
    CHECK(json["seconds"]["build"].get<double>() == Approx(seconds));
    CHECK(convertFrames(folder, "--like " + (folder / "ball.0008.vdb")).exitCode == 2);
}

TEST_CASE("frames that are missing, and triangles that change where velocities are wanted, are named")
{
    const TemporaryFolder folder;
    writeFrames(folder, 0, 6, 0.05);
    const std::pair<const char*, const char*> cases[] = {
        {"--dim 20", "2-3, 5"},
        {"--dim 20 --velocity", "--fps"},
        {"--dim 20 --fps 24", "--velocity"},
        {"--dim 20 --velocity --fps 24 --dt 0.1", "--fps"},
    };
    for (int frame : {2, 3, 5}) std::filesystem::remove(folder / numbered("ball.", frame, ".obj"));
    for (const auto& [options, words] : cases) {
        const ToolRun run = convertFrames(folder, options);
        INFO(run.err);
        CHECK((run.exitCode == 2 || run.exitCode == 3));
        CHECK(lineCount(run.err) == 1);
        CHECK_THAT(run.err, Catch::Contains(words));
    }
    for (const char* outputs : {"ball.####.obj -o one.vdb", "ball.0000.obj -o ball.####.vdb", "no.##.obj -o no.##.vdb"})
        CHECK(runTool("mesh2ls " + std::string(outputs) + " --dim 20").exitCode != 0);

    writeFrames(folder, 0, 6, 0.05);
    folder.write(numbered("ball.", 4, ".obj"), objOf(sphereMesh(1.0, 2)));
    const ToolRun changed = convertFrames(folder, "--dim 20 --velocity --fps 24 --json");
    CHECK(changed.exitCode == 3);
    CHECK(lineCount(changed.err) == 1);
    CHECK_THAT(changed.err, Catch::Contains("ball.0004.obj") && Catch::Contains("frame 3"));
    CHECK(convertFrames(folder, "--dim 20").exitCode == 0);
}

TEST_CASE("what collides with a sequence of meshes is dragged along by its velocities")
{
    const TemporaryFolder folder;
    // 0.5 units a second along z.
    writeFrames(folder, 0, 10, 0.05);
    const ToolRun run = convertFrames(folder, "--voxel " + std::to_string(kVoxel) + " --band 5vx --velocity --fps 10");
    INFO(run.err);
    REQUIRE(run.exitCode == 0);
    folder.write("cloud.csv", "x,y,z,vx,vy,vz\n0,1.02,0,0,-0.1,0\n");
    folder.write("scene.toml", "[time]\ndt = 0.01\nsteps_per_frame = 10\nframes = 3\n[world]\ngravity = [0, -1, 0]\n"
                               "[particles]\nfile = \"cloud.csv\"\n[[collider]]\nsequence = \"ball.####.vdb\"\n"
                               "restitution = 0\nfriction = 100\n[output]\nfile = \"o.csv\"\n");
    const ToolRun collide = runTool("collide " + (folder / "scene.toml"));
    INFO(collide.err);
    REQUIRE(collide.exitCode == 0);
    const Particles last = readParticles(folder / "o.csv");
    // The change of phi has no part along z at the ball's top; only the grid of velocities does.
    CHECK(last.velocity[0].z() == Approx(0.5).margin(0.02));
}
