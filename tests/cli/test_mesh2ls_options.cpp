// SPDX-License-Identifier: Apache-2.0
#include "support/run_tool.h"
#include "support/temporary_folder.h"

#include "vdbounce/io/grid_file.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <map>

using namespace vdbounce;
using namespace vdbounce::test;
using Json = nlohmann::json;

namespace {

const std::string& bunny()
{
    static const std::string path = sourcePath("data/bunny.obj");
    return path;
}

// A box with these sides around the origin, its middle moved by a quarter of a tenth along y.
std::string boxObj(double x, double y, double z)
{
    std::ostringstream out;
    for (int i = 0; i < 8; ++i) {
        out << "v " << ((i & 1) != 0 ? x : -x) / 2 << ' ' << ((i & 2) != 0 ? y : -y) / 2 + 0.05 << ' '
            << ((i & 4) != 0 ? z : -z) / 2 << '\n';
    }
    out << "f 1 5 7 3\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\nf 1 3 4 2\nf 5 6 8 7\n";
    return out.str();
}

Json converted(const std::string& mesh, const std::string& output, const std::string& options)
{
    const ToolRun run = runTool("mesh2ls " + mesh + " -o " + output + " --json " + options);
    INFO(options << ": " << run.err);
    REQUIRE(run.exitCode == 0);
    return Json::parse(run.out);
}

Json holds(const std::string& level) { return Json::parse(runTool("info --json " + level).out)["files"][0]["holds"]; }

} // namespace

TEST_CASE("closest triangles and confidence are grids of the same file, and only where they are asked for")
{
    const TemporaryFolder folder;
    const auto types = [&](const std::string& options) {
        converted(bunny(), folder / "o.vdb", "--dim 32 --name b " + options);
        std::map<std::string, std::string> found;
        for (const GridEntry& entry : listGrids(folder / "o.vdb")) found[entry.name] = entry.valueType;
        return found;
    };
    CHECK(types("") == std::map<std::string, std::string>{{"b", "float"}});
    CHECK(types("--closest --confidence") ==
          std::map<std::string, std::string>{{"b", "float"}, {"b_closest", "int32"}, {"b_confidence", "float"}});
}

TEST_CASE("what is expected to take more than --max-memory is refused by both numbers")
{
    const TemporaryFolder folder;
    const std::string mesh2ls = "mesh2ls " + bunny() + " -o " + (folder / "o.vdb") + " --dim 200 --max-memory ";
    const ToolRun refused = runTool(mesh2ls + "2M");
    CHECK(refused.exitCode == 2);
    CHECK(lineCount(refused.err) == 1);
    CHECK_THAT(refused.err, Catch::Contains("--max-memory") && Catch::Contains("would take"));
    for (const char* wrong : {"2X", "G", "0", "-1G", "1e30", "nan", "\"\""}) {
        const ToolRun run = runTool(mesh2ls + wrong);
        INFO(wrong << ": " << run.err);
        CHECK(run.exitCode == 2);
        CHECK(lineCount(run.err) == 1);
        CHECK_THAT(run.err, Catch::Contains("--max-memory"));
    }
    for (const char* enough : {"2G", "0.5t", "900000k", "2000M", "2000000000"}) {
        INFO(enough);
        CHECK(runTool(mesh2ls + enough).exitCode == 0);
    }
}

TEST_CASE("how each part is signed is in JSON, and in text where there was something to choose")
{
    const TemporaryFolder folder;
    const std::string level = folder / "o.vdb";
    const Json plain = converted(bunny(), level, "--dim 32");
    REQUIRE(plain["choices"].size() == 1);
    CHECK(plain["choices"][0]["method"] == "winding");
    CHECK(plain["choices"][0]["components"] == 1);
    CHECK(plain["choices"][0]["triangles"] == 3674);
    CHECK(plain["doubtful_voxels"].is_number());
    const auto text = [&](const std::string& mesh) {
        return runTool("mesh2ls " + mesh + " -o " + level + " --dim 32").out;
    };
    CHECK(lineCount(text(bunny())) == 1);
    CHECK_THAT(text(sourcePath("tests/data/meshes/sphere-with-hole.off")),
               Catch::Matches("(.|\n)*\nsign by winding: 1 component, [0-9,]+ triangles: open, [^\n]*\n"));
}

TEST_CASE("what to expect is said before, on stderr, to readers only")
{
    const TemporaryFolder folder;
    const std::string mesh2ls = "mesh2ls " + bunny() + " -o " + (folder / "o.vdb") + " --dim 64 ";
    const ToolRun text = runTool(mesh2ls);
    CHECK_THAT(text.err, Catch::Matches("vdbounce: [^\n]*bunny.obj: 3,674 triangles; expecting about [0-9,]+ voxels, "
                                        "[0-9.]+ [kMG]B and [0-9.]+ s\n(.|\n)*"));
    CHECK(runTool(mesh2ls + "--quiet").err.empty());
    const ToolRun json = runTool(mesh2ls + "--json");
    CHECK_THAT(json.err, !Catch::Contains("expecting"));
    const Json expected = Json::parse(json.out)["expected"];
    for (const char* key : {"active_voxels", "bytes", "cpu_seconds"}) CHECK(expected[key] > 0.0);
}

TEST_CASE("voxels may have three sides, or lie where those of another level set lie")
{
    const TemporaryFolder folder;
    const std::string flat = folder / "flat.vdb";
    const Json json = converted(bunny(), flat, "--voxel 0.2,0.1,0.15 --verify");
    CHECK(json["voxel_size"] == Json({0.2, 0.1, 0.15}));
    CHECK(json["verify"]["sign_errors"] == 0);
    CHECK(json["verify"]["max_error_vx"] < 1e-4);
    // Three times the longest side; info tells multiples of the smallest.
    CHECK(holds(flat)[0]["background"].get<double>() == Approx(0.6));

    const Json like = converted(bunny(), folder / "like.vdb", "--like " + flat);
    CHECK(like["voxel_size"] == json["voxel_size"]);
    CHECK(like["active_voxels"] == json["active_voxels"]);
    CHECK(readFile(folder / "like.vdb") == readFile(flat));

    CHECK(converted(bunny(), folder / "cube.vdb", "--voxel 0.2,0.2,0.2")["voxel_size"] == 0.2);
    converted(bunny(), folder / "same.vdb", "--voxel 0.2");
    CHECK(readFile(folder / "same.vdb") == readFile(folder / "cube.vdb"));

    for (const char* wrong : {"--voxel 1,2", "--voxel 0.1,0.1,0", "--voxel 0.1,-1,0.1", "--voxel 1 --like x.vdb"}) {
        const ToolRun run = runTool("mesh2ls " + bunny() + " -o " + (folder / "no.vdb") + " " + wrong);
        INFO(wrong << ": " << run.err);
        CHECK(run.exitCode == 2);
        CHECK(lineCount(run.err) == 1);
    }
    CHECK(runTool("mesh2ls " + bunny() + " -o " + flat + " --like " + flat).exitCode == 2);
    CHECK(runTool("mesh2ls " + bunny() + " -o " + (folder / "no.vdb") + " --like " + bunny()).exitCode == 3);
}

TEST_CASE("walls thinner than voxels are warned of, with the voxel size that would do, also where no voxel is inside")
{
    const TemporaryFolder folder;
    const std::string level = folder / "o.vdb";
    const auto converted = [&](double thickness) {
        return runTool("mesh2ls " + folder.write("plate.obj", boxObj(2, thickness, 2)) + " -o " + level +
                       " --voxel 0.1 --json");
    };
    // Half way between two layers of voxels, and half a voxel and less than a third of one thick.
    for (double thickness : {0.05, 0.03}) {
        const ToolRun run = converted(thickness);
        INFO(run.err);
        CHECK(lineCount(run.err) == 1);
        CHECK_THAT(run.err, Catch::Contains("plate.obj") && Catch::Contains("walls"));
        CHECK_THAT(run.err, Catch::Contains(thickness == 0.03 ? "0.03 thick (0.3 voxels)" : "0.05 thick (0.5 voxels)"));
        CHECK_THAT(run.err,
                   Catch::EndsWith(thickness == 0.03 ? "voxels of 0.01 would do\n" : "voxels of 0.01667 would do\n"));
        CHECK(Json::parse(run.out)["thin_walls"]["thinnest"].get<double>() == Approx(thickness).epsilon(1e-4));
    }
    CHECK(converted(0.4).err.empty());
}

TEST_CASE("verification holds to the tolerance it states, with and without --half")
{
    const TemporaryFolder folder;
    const std::string mesh2ls = "mesh2ls " + bunny() + " --dim 48 --quiet -o " + (folder / "o.vdb");
    CHECK(runTool(mesh2ls + " --verify").exitCode == 0);
    CHECK(runTool(mesh2ls + " --verify --half --band 8vx").exitCode == 0);
    std::filesystem::remove(folder / "o.vdb");
    const ToolRun missed = runTool(mesh2ls + " --verify --half --band 8vx --tolerance 1e-3vx");
    CHECK(missed.exitCode == 4);
    CHECK(lineCount(missed.err) == 1);
    CHECK(folder.fileCount() == 0);
}
