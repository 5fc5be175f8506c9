// SPDX-License-Identifier: Apache-2.0
#include "report/report_page.h"
#include "report/run_in_page.h"
#include "support/run_tool.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <map>
#include <sstream>

using namespace vdbounce;
using namespace vdbounce::test;
using Json = nlohmann::json;

namespace {

// The cases by the last words of their names, all of which begin alike.
std::map<std::string, Json> casesOf(const Json& json, const std::string& begin)
{
    std::map<std::string, Json> cases;
    for (const Json& one : json.at("cases")) {
        const auto name = one.at("name").get<std::string>();
        INFO(name);
        REQUIRE(name.rfind(begin, 0) == 0);
        CHECK(one.at("unit").is_string());
        CHECK(one.at("value").is_number());
        cases[name.substr(begin.size())] = one;
    }
    return cases;
}

} // namespace

TEST_CASE("bench mesh has the figures of both ways to make a level set")
{
    const ToolRun run =
        runTool("bench mesh --json " + sourcePath("data/bunny.obj") + " --dim 32 --repetitions 1 --threads 2");
    INFO(run.err);
    REQUIRE(run.exitCode == 0);
    CHECK(run.err.empty());
    const Json json = Json::parse(run.out);
    CHECK_THAT(json.at("machine").get<std::string>(), Catch::Contains("2 threads"));
    const auto cases = casesOf(json, "bunny.obj at 32, band 3, 2 threads, ");
    for (const char* what : {"processor time", "wall time", "largest error", "active voxels", "finished grid"}) {
        INFO(what);
        const Json& one = cases.at(what);
        CHECK(one["peer"]["name"] == "OpenVDB, meshToVolume");
        const double ours = one["value"];
        const double theirs = one["peer"]["value"];
        CHECK(ours > 0.0);
        CHECK(theirs > 0.0);
        CHECK(one["ratio"].get<double>() == Approx(theirs / ours));
    }
    CHECK(cases.at("triangles")["value"] > 1000);
    CHECK(cases.at("mesh")["value"] > 0.0);
    CHECK(cases.at("largest error")["value"] < 1e-4);
    // Both were asked for the same band.
    CHECK(cases.at("active voxels")["ratio"].get<double>() == Approx(1.0).epsilon(0.02));
}

TEST_CASE("bench mesh prints a table whose columns line up")
{
    const ToolRun run = runTool("bench mesh " + sourcePath("data/bunny.obj") + " --dim 16 32 --band 2 --repetitions 1");
    INFO(run.out << run.err);
    REQUIRE(run.exitCode == 0);
    std::istringstream text(run.out.substr(run.out.find("\n\n") + 2));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    REQUIRE(lines.size() == 3);
    for (const std::string& line : lines) CHECK(line.size() == lines.front().size());
    CHECK_THAT(lines[0], Catch::StartsWith("mesh ") && Catch::EndsWith("grid MB"));
    CHECK_THAT(lines[1], Catch::StartsWith("bunny.obj ") && Catch::Contains(" 16 "));
    CHECK_THAT(lines[2], Catch::StartsWith("bunny.obj ") && Catch::Contains(" 32 "));
}

TEST_CASE("bench mesh refuses what it cannot measure")
{
    CHECK(runTool("bench mesh missing.obj").exitCode == 3);
    CHECK(runTool("bench mesh " + sourcePath("data/bunny.obj") + " --dim 0").exitCode == 2);
    CHECK(runTool("bench mesh " + sourcePath("data/bunny.obj") + " --band 0.5").exitCode == 2);
}

TEST_CASE("bench writes a page that holds the run, or says that the build has none")
{
    const TemporaryFolder folder;
    const std::string ball = folder / "ball.vdb";
    const std::string page = folder / "report.html";
    REQUIRE(runTool("make sphere --center 0,0,0 --radius 1 --voxel 0.2 -o " + ball).exitCode == 0);
    const ToolRun run = runTool("bench field " + ball + " --points 1000 --repetitions 1 --json --html " + page);
    INFO(run.err);
    if (!report::hasReportPage()) {
        CHECK(run.exitCode == 1);
        CHECK_THAT(run.err, Catch::Contains("no report page"));
        CHECK(folder.fileCount() == 1);
        return;
    }
    REQUIRE(run.exitCode == 0);
    const Json json = Json::parse(run.out);
    CHECK(json.at("cases").size() > 10);
    const std::string command = "vdbounce bench field " + ball + " --points 1000 --repetitions 1";
    CHECK(json.at("command") == command);
    const std::string text = readFile(page);
    CHECK(Json::parse(runInPage(text)) == json);
    CHECK_THAT(text, Catch::Contains("<code id=\"command\">" + command + "</code>"));
}

TEST_CASE("every kind of bench refuses a page that it could not write, before measuring")
{
    for (const char* kind : {"field", "mesh", "make", "collide", "trade", "all"}) {
        INFO(kind);
        const std::string bench = std::string("bench ") + kind + " --html ";
        CHECK(runTool(bench + "missing/report.html").exitCode == 2);
        CHECK(runTool(bench + "report.txt").exitCode == 2);
    }
}

TEST_CASE("the command that bench tells repeats the run, whatever its files are called")
{
    const TemporaryFolder folder;
    const std::string bunny = folder / "the bunny's $mesh.obj";
    std::filesystem::copy_file(sourcePath("data/bunny.obj"), bunny);
    const ToolRun first = runTool("bench mesh \"" + (folder / "the bunny's \\$mesh.obj") +
                                  "\" --dim 16 32 --band 2.5 --repetitions 1 --threads 1 --json");
    INFO(first.err);
    REQUIRE(first.exitCode == 0);
    const Json json = Json::parse(first.out);
    const std::string command = json.at("command");
    INFO(command);
    CHECK_THAT(command, Catch::StartsWith("vdbounce bench mesh '") &&
                            Catch::EndsWith(" --dim 16 32 --band 2.5 --repetitions 1 --threads 1"));
    const ToolRun second = runTool(command.substr(command.find(' ')) + " --json");
    REQUIRE(second.exitCode == 0);
    const Json again = Json::parse(second.out);
    CHECK(again.at("command") == command);
    REQUIRE(again.at("cases").size() == json.at("cases").size());
    for (std::size_t i = 0; i < json.at("cases").size(); ++i)
        CHECK(again["cases"][i]["name"] == json["cases"][i]["name"]);
}
