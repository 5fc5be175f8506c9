// SPDX-License-Identifier: Apache-2.0
#include "support/run_tool.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>

using namespace vdbounce::test;

namespace {

void requireOneLine(const ToolRun& run, int exitCode, const std::string& contains)
{
    INFO("stderr: " << run.err << " stdout: " << run.out);
    CHECK(run.exitCode == exitCode);
    CHECK(lineCount(run.err) == 1);
    CHECK(run.out.empty());
    CHECK(run.err.rfind("vdbounce: error: ", 0) == 0);
    CHECK_THAT(run.err, Catch::Contains(contains) && Catch::Contains(";"));
}

} // namespace

TEST_CASE("wrong usage ends in one line and exit code 2, and leaves no file")
{
    const TemporaryFolder folder;
    const std::string bunny = sourcePath("data/bunny.obj");
    const std::string out = " -o " + (folder / "o.vdb");
    const std::pair<std::string, std::string> cases[] = {
        {"", "subcommand"},
        {"fly", "fly"},
        {"mesh2ls " + bunny, "--output"},
        {"mesh2ls " + bunny + out, "--voxel and --dim"},
        {"mesh2ls " + bunny + out + " --dim 32 --voxel 1", "--voxel and --dim"},
        {"mesh2ls " + bunny + out + " --dim 0", "--dim"},
        {"mesh2ls " + bunny + out + " --dim many", "--dim"},
        {"mesh2ls " + bunny + out + " --voxel -1", "--voxel"},
        {"mesh2ls " + bunny + out + " --voxel 3px", "--voxel"},
        {"mesh2ls " + bunny + out + " --dim 32 --band 0.1vx", "band"},
        {"mesh2ls " + bunny + out + " --dim 32 --sign maybe", "--sign"},
        {"mesh2ls " + bunny + out + " --dim 32 --turbo", "--turbo"},
        {"mesh2ls " + bunny + out + " --dim 32 --threads -1", "--threads"},
        {"emit box --min 0,0 --max 1,1,1 -n 5" + out, "0,0"},
        {"emit box --min 1,1,1 --max 0,0,0 -n 5" + out, "--min"},
        {"emit box --min 0,0,0 --max 1,1,1 -n 5 -o " + (folder / "o.txt"), "no format"},
        {"emit cone -n 5" + out, "cone"},
        {"emit box --min 0,0,0 --max 1,1,1 -n -5" + out, "-n"},
        {"emit box --min 0,0,0 --max 1,1,1 -n 1e18" + out, "1e18"},
        {"mesh2ls " + bunny + " --dim 32 -o " + (folder / "o.foo"), "'.foo'"},
        {"slice b.vdb --axis w -o " + (folder / "o.png"), "use one of: x, y, z"},
        {"render b.vdb -o " + (folder / "o.jpg"), "'.jpg'"},
        {"collide --set time.dt=1 --collider a.vdb --particles b.csv --steps 3" + out, "--set"},
        {"collide", "neither a scene"},
        {"collide nothing.toml --frames x", "nothing.toml"},
    };
    for (const auto& [arguments, contains] : cases) {
        INFO(arguments);
        const ToolRun run = runTool(arguments);
        requireOneLine(run, arguments.find("nothing.toml") == std::string::npos ? 2 : 3, contains);
    }
    CHECK(folder.fileCount() == 0);
}

TEST_CASE("bad input ends in one line and exit code 3, and leaves no file")
{
    const TemporaryFolder folder;
    const std::string out = " -o " + (folder / "o.vdb");
    const std::string broken = folder.write("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
    const std::string junk = folder.write("junk.vdb", "junk");
    const std::string cloud = folder.write("cloud.csv", "x,y,z\n0,5,0\n");
    const std::string scene = folder.write("scene.toml", "[time]\nframez = 3\n[particles]\nfile = \"cloud.csv\"\n");
    const std::string lost = folder.write(
        "lost.toml",
        "[particles]\nfile = \"cloud.csv\"\n[[collider]]\nfile = \"no.vdb\"\n[output]\nfile = \"o.####.vdb\"\n");
    const std::size_t before = folder.fileCount();
    const std::pair<std::string, std::string> cases[] = {
        {"mesh2ls missing.obj --dim 32" + out, "missing.obj"},
        {"mesh2ls " + broken + " --dim 32" + out, "broken.obj:4"},
        {"info " + junk, "junk.vdb"},
        {"info " + (folder / "missing.vdb"), "missing.vdb"},
        {"sample " + junk + " --at " + cloud + " -o " + (folder / "s.csv"), "junk.vdb"},
        {"convert " + junk + " " + (folder / "c.csv"), "junk.vdb"},
        {"render " + junk + " -o " + (folder / "r.png"), "junk.vdb"},
        {"slice " + junk + " -o " + (folder / "r.png"), "junk.vdb"},
        {"collide " + scene, "scene.toml:2: unknown key 'time.framez'"},
        {"collide " + lost, "no.vdb"},
        {"collide --collider " + junk + " --particles " + cloud + " --steps 3" + out, "junk.vdb"},
    };
    for (const auto& [arguments, contains] : cases) {
        INFO(arguments);
        requireOneLine(runTool(arguments), 3, contains);
    }
    CHECK(folder.fileCount() == before);
}

TEST_CASE("a place that cannot be written to ends in one line and exit code 1")
{
    const TemporaryFolder folder;
    requireOneLine(runTool("emit box --min 0,0,0 --max 1,1,1 -n 5 -o " + (folder / "no/o.csv")), 1, "no/o.csv");
    requireOneLine(runTool("emit box --min 0,0,0 --max 1,1,1 -n 5 -o /dev/full/o.csv"), 1, "/dev/full/o.csv");
}

TEST_CASE("a tolerance that is not met ends with exit code 4 and writes nothing")
{
    const TemporaryFolder folder;
    const std::string mesh2ls = "mesh2ls " + sourcePath("data/bunny.obj") + " --dim 48 -o " + (folder / "o.vdb");
    requireOneLine(runTool(mesh2ls + " --tolerance 1e-9vx --json"), 4, "tolerance");
    CHECK(folder.fileCount() == 0);
    CHECK(runTool(mesh2ls + " --tolerance 1e-4vx --quiet").exitCode == 0);
}

TEST_CASE("every verb has help with an example, and the tool a version")
{
    for (const char* verb : {"mesh2ls", "info", "sample", "emit", "emit box", "emit sphere", "emit surface", "convert",
                             "collide", "render", "slice", "bench", "bench field", "bench collide"}) {
        INFO(verb);
        const ToolRun run = runTool(std::string(verb) + " --help");
        CHECK(run.exitCode == 0);
        CHECK(run.err.empty());
        CHECK_THAT(run.out, Catch::Contains("Example") && Catch::Contains(std::string("vdbounce ") + verb));
        if (std::string(verb) != "emit" && std::string(verb) != "bench")
            CHECK_THAT(run.out,
                       Catch::Contains("--threads") && Catch::Contains("--json") && Catch::Contains("--quiet"));
    }
    CHECK(runTool("--help").exitCode == 0);
    CHECK(runTool("--version").exitCode == 0);
}

TEST_CASE("an input is never written over")
{
    const TemporaryFolder folder;
    const std::string points = folder.write("p.csv", "x,y,z\n0,5,0\n");
    REQUIRE(runTool("mesh2ls " + sourcePath("data/bunny.obj") + " --dim 32 -o " + (folder / "b.vdb")).exitCode == 0);
    const std::string before = readFile(points);
    std::filesystem::create_symlink("p.csv", folder / "link.csv");
    requireOneLine(runTool("sample " + (folder / "b.vdb") + " --at " + points + " -o " + points), 2, "is the input");
    requireOneLine(runTool("convert " + points + " " + (folder / "link.csv")), 2, "is the input");
    requireOneLine(
        runTool("collide --collider " + (folder / "b.vdb") + " --particles " + points + " --steps 3 -o " + points), 2,
        "is the input");
    CHECK(readFile(points) == before);

    // A frame's name counts, not only the pattern.
    const std::string first = folder.write("out.0003.csv", before);
    const std::string scene = folder.write(
        "s.toml", "[time]\nframes = 5\n[particles]\nfile = \"out.0003.csv\"\n[output]\nfile = \"out.####.csv\"\n");
    requireOneLine(runTool("collide " + scene), 2, "writing frame 3 would destroy");
    CHECK(readFile(first) == before);
    CHECK_FALSE(std::filesystem::exists(folder / "out.0000.csv"));
}
