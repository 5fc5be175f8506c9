// SPDX-License-Identifier: Apache-2.0
#include "support/run_tool.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstring>

using namespace vdbounce::test;
using Json = nlohmann::json;

namespace {

std::string defect(const std::string& name) { return sourcePath("tests/data/meshes/" + name); }

ToolRun mesh2ls(const std::string& mesh, const std::string& output, const std::string& options)
{
    return runTool("mesh2ls " + mesh + " -o " + output + " " + options);
}

// A box from -half to half around (centre, centre, centre), as obj.
std::string boxObj(double half, double centre)
{
    std::ostringstream out;
    out.precision(17);
    for (int i = 0; i < 8; ++i) {
        out << "v";
        for (int axis = 0; axis < 3; ++axis) out << ' ' << centre + ((i >> axis & 1) != 0 ? half : -half);
        out << '\n';
    }
    out << "f 1 5 7 3\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\nf 1 3 4 2\nf 5 6 8 7\n";
    return out.str();
}

// Whether walls are too thin for the voxels, and gaps.
std::size_t thinKinds(const Json& json)
{
    return std::size_t(json["thin_walls"]["voxels"] > 0) + std::size_t(json["thin_gaps"]["voxels"] > 0);
}

// The column phi of what the tool samples at these points.
std::vector<double> sampled(const TemporaryFolder& folder, const std::string& level, const std::string& points)
{
    const std::string table = folder / "sampled.csv";
    const ToolRun run =
        runTool("sample " + level + " --at " + folder.write("points.csv", "x,y,z\n" + points) + " -o " + table);
    INFO(run.err);
    REQUIRE(run.exitCode == 0);
    std::istringstream rows(readFile(table));
    std::string row;
    std::vector<double> phi;
    std::getline(rows, row);
    while (std::getline(rows, row)) {
        std::istringstream columns(row);
        std::string column;
        for (int i = 0; i < 4; ++i) std::getline(columns, column, ',');
        phi.push_back(std::stod(column));
    }
    return phi;
}

} // namespace

TEST_CASE("mesh2ls warns about a mesh's defects and converts it all the same")
{
    const TemporaryFolder folder;
    const std::pair<const char*, const char*> cases[] = {
        {"degenerate.off", "(degenerate|without area|zero area|no area)"},
        {"duplicate-vertices.off", "(duplicate|same (place|position)|equal p|coincide)"},
        {"duplicate-vertices.off", "(unreferenced|unused|not used|no (face|triangle) uses)"},
        {"duplicate-faces.off", "(duplicate|twice|more than once|three triangles or more)"},
        {"cubes-sharing-edge.off", "(non-manifold|three triangles or more)"},
        {"cube-with-inner-wall.off", "(non-manifold|three triangles or more)"},
        {"sphere-with-hole.off", "open"},
        {"reversed-half.off", "(opposite|inconsistent|orient)"},
    };
    for (const auto& [mesh, words] : cases) {
        const std::string level = folder / "o.vdb";
        const ToolRun run = mesh2ls(defect(mesh), level, "--dim 40 --json");
        INFO(mesh << ": " << run.err);
        CHECK(run.exitCode == 0);
        CHECK_THAT(run.err, Catch::Matches("(.|\n)*vdbounce: warning: [^\n]*" + std::string(mesh) + ": [^\n]*" + words +
                                               "(.|\n)*",
                                           Catch::CaseSensitive::No));
        const Json json = Json::parse(run.out);
        CHECK(json["warnings"].size() + thinKinds(json) == lineCount(run.err)); // a line each
        CHECK(json["active_voxels"] > 1000);
        CHECK(runTool("info " + level).exitCode == 0);
        std::filesystem::remove(level);
    }
}

TEST_CASE("mesh2ls says nothing about a sound mesh, several parts and cavities included")
{
    const TemporaryFolder folder;
    for (const char* mesh : {"nested-shells.off", "boxes-with-gap.off", "faces-on-voxels.off", "cavity.stl"}) {
        const ToolRun run = mesh2ls(defect(mesh), folder / "o.vdb", "--dim 40 --tolerance 1e-4vx --json");
        INFO(mesh << ": " << run.err);
        CHECK(run.exitCode == 0);
        const Json json = Json::parse(run.out);
        CHECK(json["warnings"].empty());
        CHECK(thinKinds(json) == lineCount(run.err));
    }
}

TEST_CASE("a mesh ten million units from the origin is as exact as one at the origin")
{
    const TemporaryFolder folder;
    // Halves and a voxel of 1/16 are exact at 1e7, so that both grids ask for the same distances.
    const std::string near = folder.write("near.obj", boxObj(1.0, 0.0));
    const std::string far = folder.write("far.obj", boxObj(1.0, 1e7));
    const ToolRun first = mesh2ls(near, folder / "near.vdb", "--voxel 0.0625 --json --tolerance 1e-4vx");
    const ToolRun second = mesh2ls(far, folder / "far.vdb", "--voxel 0.0625 --json --tolerance 1e-4vx");
    INFO(first.err << second.err);
    REQUIRE(first.exitCode == 0);
    REQUIRE(second.exitCode == 0);
    CHECK(Json::parse(first.out)["active_voxels"] == Json::parse(second.out)["active_voxels"]);
    CHECK(Json::parse(second.out)["verify"]["sign_errors"] == 0);

    const auto a = sampled(folder, folder / "near.vdb", "0,0,0\n0.9375,0.25,0.5\n1.125,0,0.125\n1.0625,1.0625,0\n");
    const auto b = sampled(folder, folder / "far.vdb",
                           "1e7,1e7,1e7\n10000000.9375,10000000.25,10000000.5\n10000001.125,10000000,10000000.125\n"
                           "10000001.0625,10000001.0625,10000000\n");
    REQUIRE(a.size() == 4);
    REQUIRE(b.size() == 4);
    for (std::size_t i = 0; i < a.size(); ++i) CHECK(b[i] == Approx(a[i]).margin(1e-6));
    CHECK(a[1] == Approx(-0.0625).margin(1e-6));
    CHECK(a[2] == Approx(0.125).margin(1e-6));

    // A voxel that is no power of two: its centres are rounded to 2e-9 there, 4e-8 of a voxel.
    CHECK(mesh2ls(far, folder / "far.vdb", "--dim 40 --tolerance 1e-4vx --quiet").exitCode == 0);
}

TEST_CASE("a voxel larger than the mesh makes a level set that can be read")
{
    const TemporaryFolder folder;
    for (const char* voxel : {"12", "100", "10000"}) {
        const ToolRun run = mesh2ls(sourcePath("data/bunny.obj"), folder / "o.vdb",
                                    "--json --tolerance 1e-4vx --voxel " + std::string(voxel));
        INFO("voxel " << voxel << ": " << run.err);
        CHECK(run.exitCode == 0);
        CHECK(Json::parse(run.out)["active_voxels"] > 0);
        CHECK(runTool("info " + (folder / "o.vdb")).exitCode == 0);
    }
}

TEST_CASE("a position that is no number is refused where it stands")
{
    const TemporaryFolder folder;
    std::string stl = std::string(80, ' ') + std::string("\x02\0\0\0", 4) + std::string(100, '\0');
    const float bad = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(stl.data() + 84 + 50 + 12 + 4, &bad, sizeof bad); // the second triangle's first corner, y
    const std::string ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                            "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                            "0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n";
    const std::pair<std::string, std::string> cases[] = {
        // and the line, or the element counted from 0
        {folder.write("nan.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n"), "nan.obj:2:"},
        {folder.write("inf.obj", "v 0 0 0\nv 1 0 0\nv 0 inf 0\nf 1 2 3\n"), "inf.obj:3:"},
        {folder.write("nan.off", "OFF\n3 1 0\n0 0 0\nNaN 0 0\n0 1 0\n3 0 1 2\n"), "nan.off(:4|: point 1):"},
        {folder.write("huge.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1e999 0\n3 0 1 2\n"), "huge.off(:5|: point 2):"},
        {folder.write("nan.ply", ply), "nan.ply(:11|: (point|vertex) 1):"},
        {folder.write("nan.stl", stl), "nan.stl: triangle 1:"},
    };
    const std::size_t before = folder.fileCount();
    for (const auto& [mesh, place] : cases) {
        const ToolRun run = mesh2ls(mesh, folder / "o.vdb", "--dim 32");
        INFO(mesh << ": " << run.err);
        CHECK(run.exitCode == 3);
        CHECK(lineCount(run.err) == 1);
        CHECK_THAT(run.err, Catch::Matches("vdbounce: error: [^\n]*/" + place + "[^\n]*;[^\n]*\n"));
    }
    CHECK(folder.fileCount() == before);
}

TEST_CASE("a voxel a millionth of the mesh is refused at once, for the memory it would take")
{
    const TemporaryFolder folder;
    const std::string box = folder.write("box.obj", boxObj(50.0, 0.0));
    const std::pair<std::string, const char*> cases[] = {
        {box, "--voxel 1e-4"},
        {box, "--dim 1000000"},
        {box, "--voxel 1e-4 --sign unsigned"},
        {defect("torn.off"), "--voxel 2e-5 --band 100vx"},
    };
    const std::size_t before = folder.fileCount();
    for (const auto& [mesh, options] : cases) {
        const auto start = std::chrono::steady_clock::now();
        const ToolRun run = mesh2ls(mesh, folder / "o.vdb", options);
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        INFO(options << ": " << run.err);
        CHECK((run.exitCode == 2 || run.exitCode == 3));
        CHECK(lineCount(run.err) == 1);
        CHECK_THAT(run.err, Catch::StartsWith("vdbounce: error: ") && Catch::Contains(" GB"));
        CHECK(seconds < 3.0);
    }
    CHECK(folder.fileCount() == before);
}

TEST_CASE("a voxel too small for how far away the mesh is, is refused by the voxel's size")
{
    const TemporaryFolder folder;
    const ToolRun run = mesh2ls(folder.write("far.obj", boxObj(1.0, 1e7)), folder / "o.vdb", "--voxel 1e-3");
    INFO(run.err);
    CHECK((run.exitCode == 2 || run.exitCode == 3));
    CHECK(lineCount(run.err) == 1);
    CHECK_THAT(run.err, Catch::Contains("voxel size") && Catch::Contains("origin"));
    CHECK(folder.fileCount() == 1);
}
