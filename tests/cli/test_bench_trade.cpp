// SPDX-License-Identifier: Apache-2.0
#include "support/run_tool.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <set>

using namespace vdbounce::test;
using Json = nlohmann::json;

namespace {

Json trade(const std::string& arguments)
{
    const ToolRun run = runTool("bench trade " + arguments + " --points 2000 --shots 50 --repetitions 1 --json");
    INFO(run.err);
    REQUIRE(run.exitCode == 0);
    return Json::parse(run.out);
}

// The one case of a group that has these settings.
Json caseOf(const Json& run, const std::string& group, const Json& settings)
{
    Json found;
    for (const Json& one : run["cases"]) {
        bool same = one["group"] == group;
        for (const auto& [key, value] : settings.items()) same = same && one["settings"][key] == value;
        if (!same) continue;
        CHECK(found.is_null());
        found = one;
    }
    INFO(group << " " << settings);
    REQUIRE_FALSE(found.is_null());
    return found;
}

double errorOf(const Json& one, const char* name) { return one["error"].at(name).get<double>(); }

// What cases of a group are compared by: of steps the time for a second of the scene.
double priceOf(const Json& one)
{
    const bool steps = !one["settings"]["dt"].is_null();
    const double ns = one["cost"]["ns_per_particle_step"].get<double>();
    if (!steps) return ns;
    const double price = one["cost"]["us_per_particle_second"].get<double>();
    CHECK(price == Approx(1e-3 * ns / one["settings"]["dt"].get<double>()));
    return price;
}

void checkPareto(const Json& run, const std::string& group, const char* error)
{
    int optimal = 0;
    for (const Json& one : run["cases"]) {
        if (one["group"] != group) continue;
        bool beaten = false;
        for (const Json& other : run["cases"]) {
            if (other["group"] != group) continue;
            const double cost = priceOf(one) - priceOf(other);
            const double off = errorOf(one, error) - errorOf(other, error);
            beaten = beaten || (cost >= 0.0 && off >= 0.0 && (cost > 0.0 || off > 0.0));
        }
        INFO(one["name"]);
        CHECK(one["pareto"].get<bool>() == !beaten);
        optimal += beaten ? 0 : 1;
    }
    CHECK(optimal > 0);
}

// A folder with a ball, a cloud of 200 particles above it and a scene with these lines added.
class FallingCloud : public TemporaryFolder {
public:
    explicit FallingCloud(const std::string& lines)
    {
        REQUIRE(runTool("make sphere --center 0,0,0 --radius 1 --voxel 0.1 -o " + (*this / "ball.vdb")).exitCode == 0);
        REQUIRE(runTool("emit box --min -0.8,1.3,-0.8 --max 0.8,1.8,0.8 -n 200 -o " + (*this / "cloud.csv")).exitCode ==
                0);
        write("scene.toml", "[output]\nfile = \"out.csv\"\n[particles]\nfile = \"cloud.csv\"\nradius = 0.02\n" + lines);
    }

    ToolRun run(const std::string& options = "--repetitions 1") const
    {
        return runTool("bench trade " + (*this / "scene.toml") + " " + options + " --json");
    }

    Json cases() const
    {
        const ToolRun done = run();
        INFO(done.err);
        REQUIRE(done.exitCode == 0);
        CHECK_FALSE(std::filesystem::exists(*this / "out.csv"));
        return Json::parse(done.out);
    }
};

std::set<std::string> errorNames(const Json& one)
{
    std::set<std::string> names;
    for (const auto& [name, value] : one["error"].items()) names.insert(name);
    return names;
}

} // namespace

TEST_CASE("bench trade has what each choice costs and how wrong it is")
{
    const Json run = trade("");
    std::set<std::string> groups;
    for (const Json& one : run["cases"]) {
        groups.insert(one["group"]);
        for (const char* key : {"voxel", "lookup", "normal", "storage", "scheme", "sweep", "dt"})
            CHECK(one["settings"].contains(key));
        for (const char* key : {"ns_per_particle_step", "build_seconds", "bytes"}) CHECK(one["cost"].at(key) > 0.0);
        for (const auto& [name, value] : one["error"].items()) CHECK(value.get<double>() >= 0.0);
    }
    CHECK(groups == std::set<std::string>{"sphere, lookups", "torus, lookups", "box, lookups", "shots at a ball, steps",
                                          "sliding down a slope, steps"});
    checkPareto(run, "sphere, lookups", "phi_p99");
    checkPareto(run, "shots at a ball, steps", "place_of_impact_vx");

    const auto sphere = [&](double voxel, const char* lookup, const char* storage) {
        return caseOf(run, "sphere, lookups",
                      {{"voxel", voxel}, {"lookup", lookup}, {"normal", "analytic"}, {"storage", storage}});
    };
    // Linear interpolation is of second order, that of the nearest value of first.
    const Json fine = sphere(1.0 / 64, "trilinear", "float");
    const Json coarse = sphere(1.0 / 16, "trilinear", "float");
    CHECK(errorOf(coarse, "phi_mean") / errorOf(fine, "phi_mean") == Approx(16.0).epsilon(0.2));
    CHECK(errorOf(sphere(1.0 / 16, "nearest", "float"), "phi_mean") /
              errorOf(sphere(1.0 / 64, "nearest", "float"), "phi_mean") ==
          Approx(4.0).epsilon(0.2));
    // The interpolant's curvature: at most (1/8) h^2 times the sum of both curvatures, 2 / r a voxel or two inside.
    CHECK(errorOf(fine, "phi_max_vx") < 0.25 / 62);
    CHECK(errorOf(sphere(1.0 / 64, "cubic", "float"), "phi_mean") < 0.1 * errorOf(fine, "phi_mean"));
    CHECK(errorOf(sphere(1.0 / 64, "trilinear", "fixed8"), "phi_mean") > errorOf(fine, "phi_mean"));
    CHECK(sphere(1.0 / 64, "trilinear", "half")["cost"]["bytes"] < fine["cost"]["bytes"]);
}

TEST_CASE("bench trade has gradients that are stored, with the errors of those that are computed")
{
    const Json run = trade("");
    for (const char* group : {"sphere, lookups", "torus, lookups", "box, lookups"}) {
        for (const double voxel : {1.0 / 64, 1.0 / 32, 1.0 / 16}) {
            const auto usual = [&](const char* normal) {
                return caseOf(run, group,
                              {{"voxel", voxel}, {"lookup", "trilinear"}, {"normal", normal}, {"storage", "float"}});
            };
            const Json stored = usual("precomputed");
            const Json computed = usual("central");
            for (const auto& [name, value] : computed["error"].items()) {
                INFO(group << ", voxel " << voxel << ", " << name);
                const bool angle = name.find("_deg") != std::string::npos;
                CHECK(errorOf(stored, name.c_str()) == Approx(value.get<double>()).margin(angle ? 1e-3 : 1e-6));
            }
            CHECK(stored["cost"]["bytes"] > computed["cost"]["bytes"]);
        }
    }
}

TEST_CASE("bench trade measures steps against ways that are known")
{
    const Json run = trade("");
    const auto shots = [&](const char* scheme, const char* sweep, double dt) {
        return caseOf(run, "shots at a ball, steps",
                      {{"voxel", 1.0 / 64},
                       {"lookup", "trilinear"},
                       {"normal", "central"},
                       {"storage", "float"},
                       {"scheme", scheme},
                       {"sweep", sweep},
                       {"dt", dt}});
    };
    const Json good = shots("collide-contact", "always", 1.0 / 800);
    CHECK(errorOf(good, "missed") == 0.0);
    CHECK(errorOf(good, "penetration_vx") < 0.01);
    CHECK(errorOf(good, "time_of_impact_s") < 1e-4);
    CHECK(errorOf(good, "place_of_impact_vx") < 0.1);
    // Up to 100 units a second: without a sweep the place is off by a part of the step's way, and some pass through.
    const Json careless = shots("once", "never", 1.0 / 50);
    CHECK(errorOf(careless, "place_of_impact_vx") > 10.0 * errorOf(good, "place_of_impact_vx"));
    CHECK(errorOf(careless, "missed") > 0.0);
    const Json slide = caseOf(run, "sliding down a slope, steps",
                              {{"voxel", 1.0 / 64},
                               {"lookup", "trilinear"},
                               {"normal", "central"},
                               {"storage", "float"},
                               {"scheme", "collide-contact"},
                               {"sweep", "auto"},
                               {"dt", 1.0 / 800}});
    CHECK(errorOf(slide, "sliding_distance_relative") < 0.01);
}

TEST_CASE("bench trade takes meshes and level sets")
{
    const Json mesh = trade(sourcePath("data/bunny.obj") + " --dim 32");
    const Json one = caseOf(mesh, "bunny.obj, lookups",
                            {{"voxel", mesh["cases"][0]["settings"]["voxel"]},
                             {"lookup", "trilinear"},
                             {"normal", "central"},
                             {"storage", "float"}});
    CHECK(errorOf(one, "phi_mean_vx") < 0.1);
    CHECK(errorOf(one, "phi_mean_vx") > 1e-4);
    CHECK(runTool("bench trade missing.vdb").exitCode == 3);
    CHECK(runTool("bench trade --points 1").exitCode == 2);
    // Before measuring.
    CHECK(runTool("bench trade --html missing/trade.html").exitCode == 2);
    CHECK(runTool("bench trade --html trade.txt").exitCode == 2);
}

TEST_CASE("bench trade runs a scene with every choice")
{
    const FallingCloud folder("[contact]\nsweep = \"always\"\n[[collider]]\nfile = \"ball.vdb\"\n");
    const Json run = folder.cases();
    std::set<double> timeSteps;
    for (const Json& one : run["cases"]) {
        CHECK(one["group"] == "scene.toml, steps");
        CHECK(one["settings"]["voxel"] == Approx(0.1));
        for (const char* key : {"lookup", "normal", "storage", "scheme", "sweep"})
            CHECK(one["settings"].at(key).is_string());
        timeSteps.insert(one["settings"]["dt"].get<double>());
        for (const char* key : {"ns_per_particle_step", "build_seconds", "bytes"}) CHECK(one["cost"].at(key) > 0.0);
        CHECK(errorNames(one) == std::set<std::string>{"place_of_impact_vx", "place_of_impact_max_vx",
                                                       "time_of_impact_s", "time_of_impact_max_s", "missed",
                                                       "penetration_vx", "energy_drift", "final_position_vx"});
        for (const auto& [name, value] : one["error"].items()) CHECK(value.get<double>() >= 0.0);
        CHECK(errorOf(one, "missed") < 0.1);
    }
    CHECK(run["cases"].size() == 18 + 35);
    CHECK(timeSteps == std::set<double>{0.008, 0.004, 0.002, 0.001});
    checkPareto(run, "scene.toml, steps", "place_of_impact_vx");

    const auto step = [&](const char* lookup, const char* normal, const char* sweep, double dt) {
        return caseOf(run, "scene.toml, steps",
                      {{"lookup", lookup},
                       {"normal", normal},
                       {"storage", "float"},
                       {"scheme", "collide-contact"},
                       {"sweep", sweep},
                       {"dt", dt}});
    };
    for (const char* error : {"place_of_impact_vx", "time_of_impact_s"}) {
        const double nearest = errorOf(step("nearest", "central", "always", 0.004), error);
        const double trilinear = errorOf(step("trilinear", "central", "always", 0.004), error);
        CHECK(trilinear < 0.3 * nearest);
        CHECK(errorOf(step("cubic", "analytic", "always", 0.004), error) < 0.3 * trilinear);
        // Where nothing is swept a particle is up to a step's way too deep.
        CHECK(errorOf(step("trilinear", "central", "never", 0.001), error) <
              0.5 * errorOf(step("trilinear", "central", "never", 0.008), error));
    }
}

TEST_CASE("bench trade runs scenes without level sets, free bodies and colliders that delete")
{
    const FallingCloud folder(
        "[time]\nsteps_per_frame = 1\nframes = 200\n[[collider]]\nsphere = { center = [0, 0, 0], radius = 1 }\n"
        "mass = 1\nmotion = { velocity = [0, 5, 0] }\n"
        "[[collider]]\nplane = { point = [0, -1, 0], normal = [0, 1, 0] }\non_hit = \"delete\"\n");
    const Json run = folder.cases();
    // Frames of one step have none that is twice as long.
    CHECK(run["cases"].size() == 27);
    for (const Json& one : run["cases"]) {
        CHECK(one["settings"]["voxel"].is_null());
        CHECK(one["cost"]["bytes"] == 0);
        CHECK(errorOf(one, "place_of_impact") < 0.05);
    }
    checkPareto(run, "scene.toml, steps", "place_of_impact");
}

TEST_CASE("bench trade runs scenes with moving colliders, sequences and particles that meet")
{
    const FallingCloud folder(
        "interact = true\n[time]\nframes = 2\nsteps_per_frame = 3\ndt = 0.05\n[[collider]]\nsequence = \"s.#.vdb\"\n"
        "[[collider]]\nsphere = { center = [0, -2, 0], radius = 0.5 }\n"
        "motion = { velocity = [0, 30, 0] }\n");
    for (int frame = 0; frame <= 2; ++frame) {
        REQUIRE(runTool("make sphere --center 0,0,0 --voxel 0.1 --radius 1." + std::to_string(frame) + " -o " +
                        (folder / ("s." + std::to_string(frame) + ".vdb")))
                    .exitCode == 0);
    }
    for (const Json& one : folder.cases()["cases"]) {
        CHECK(errorOf(one, "missed") < 0.1);
        CHECK(errorOf(one, "final_position_vx") < 5.0);
    }
}

TEST_CASE("bench trade says in one line why a scene cannot be measured")
{
    const auto refused = [](const FallingCloud& folder, int exitCode, const char* reason) {
        const ToolRun run = folder.run();
        INFO(run.err);
        CHECK(run.exitCode == exitCode);
        CHECK(lineCount(run.err) == 1);
        CHECK_THAT(run.err, Catch::Contains(reason));
    };
    refused(FallingCloud("[time]\ndt = -1.0\n"), 3, "scene.toml:7: time.dt");
    refused(FallingCloud("[[collider]]\nfile = \"missing.vdb\"\n"), 3, "missing.vdb");
    refused(FallingCloud("[time]\nframes = 0\n"), 2, "time.frames");
    refused(FallingCloud("[[collider]]\nplane = { point = [0, -9, 0], normal = [0, 1, 0] }\n"), 2, "25 of 48 frames");
    refused(FallingCloud("[[collider]]\nname = \"ball\"\nfile = \"ball.vdb\"\nmass = 1\non_hit = \"delete\"\n"), 2,
            "'ball'");
}

TEST_CASE("every cost and error of bench trade has its spread over repetitions, of which each has points of its own")
{
    const ToolRun run = runTool("bench trade --points 2000 --shots 50 --repetitions 3 --json");
    REQUIRE(run.exitCode == 0);
    int differing = 0;
    const Json json = Json::parse(run.out);
    for (const Json& one : json["cases"]) {
        INFO(one["name"]);
        Json figures = one["error"];
        for (const char* cost : {"ns_per_particle_step", "build_seconds"}) figures[cost] = one["cost"][cost];
        for (const auto& [name, value] : figures.items()) {
            const Json& spread = one["spread"].at(name);
            CHECK(spread[0].get<double>() <= value.get<double>());
            CHECK(value.get<double>() <= spread[1].get<double>());
        }
        const char* const first = one["error"].contains("phi_p99") ? "phi_p99" : nullptr;
        if (first != nullptr && one["spread"][first][0] < one["spread"][first][1]) ++differing;
    }
    CHECK(differing > 0);
}
