// SPDX-License-Identifier: Apache-2.0
#include "support/run_tool.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <map>
#include <sstream>

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
