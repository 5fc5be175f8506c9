// SPDX-License-Identifier: Apache-2.0
#include "support/run_tool.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <fstream>
#include <regex>
#include <sstream>

using namespace vdbounce::test;
using Json = nlohmann::json;

namespace {

std::string contentOf(const std::string& path)
{
    std::ifstream in(path);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

// Particles that fall on a ball which has 16 voxels in its radius.
class BallScene {
public:
    BallScene()
    {
        run("make sphere --center 0.01,0.02,0.03 --radius 1 --voxel 0.0625 -o " + path("ball.vdb"));
        run("emit box --min=-1,1.2,-1 --max=1,1.6,1 -n 300 --seed 4 -o " + path("p.csv"));
    }

    std::string path(const std::string& name) const { return folder_ / name; }

    void run(const std::string& arguments) const
    {
        const ToolRun done = runTool(arguments);
        INFO(done.err);
        REQUIRE(done.exitCode == 0);
    }

    ToolRun collide(const std::string& accuracy, const std::string& options = "",
                    const std::string& collider = "file = \"ball.vdb\"") const
    {
        std::ofstream(path("scene.toml")) << "[time]\ndt = 0.005\nsteps_per_frame = 20\nframes = 2\n[particles]\n"
                                             "file = \"p.csv\"\n[accuracy]\n"
                                          << accuracy << "\n[[collider]]\nname = \"ball\"\n"
                                          << collider << "\n[output]\nfile = \"out.csv\"\n";
        return runTool("collide " + path("scene.toml") + " --json " + options);
    }

    Json report(const std::string& accuracy, const std::string& options = "",
                const std::string& collider = "file = \"ball.vdb\"") const
    {
        const ToolRun done = collide(accuracy, options, collider);
        INFO(done.err);
        REQUIRE(done.exitCode == 0);
        return Json::parse(done.out);
    }

private:
    TemporaryFolder folder_;
};

} // namespace

TEST_CASE("max_error takes the cheapest choice that is within it, and says what it measured")
{
    const BallScene scene;
    // Against the formula trilinear lookups are off by 0.0158 voxels, their own slope by 0.0195, splines by 0.0002.
    const struct {
        const char* asked;
        double vx;
        Json chosen;
    } cases[] = {
        {"max_error = \"0.05vx\"", 0.05, {{"lookup", "trilinear"}, {"normal", "analytic"}, {"storage", "float"}}},
        {"max_error = \"0.017vx\"", 0.017, {{"lookup", "trilinear"}, {"normal", "central"}, {"storage", "float"}}},
        {"max_error = 0.0003", 0.0048, {{"lookup", "cubic"}, {"normal", "analytic"}, {"storage", "float"}}},
    };
    for (const auto& c : cases) {
        INFO(c.asked);
        const Json report = scene.report(c.asked);
        CHECK(report["chosen"] == c.chosen);
        CHECK(report["measured_error_vx"] <= c.vx);
        CHECK(report["measured_error_vx"] > 0.0);
        const std::string planned = contentOf(scene.path("out.csv"));
        std::string byHand;
        for (const auto& [key, value] : c.chosen.items()) byHand += key + " = " + value.dump() + "\n";
        CHECK_FALSE(scene.report(byHand).contains("chosen"));
        CHECK(contentOf(scene.path("out.csv")) == planned);
    }
}

TEST_CASE("the option --max-error takes the place of what the scene says")
{
    const BallScene scene;
    const Json report = scene.report("lookup = \"nearest\"", "--max-error 0.005vx");
    CHECK(report["chosen"]["lookup"] == "cubic");
    CHECK(report["measured_error_vx"] <= 0.005);
    CHECK(scene.report("max_error = 0.0001", "--max-error 0.05vx")["chosen"]["lookup"] == "trilinear");
}

TEST_CASE("a max_error that nothing reaches names what can be, and a voxel size that does")
{
    const BallScene scene;
    const ToolRun refused = scene.collide("max_error = \"0.0002vx\"");
    CHECK(refused.exitCode == 4);
    CHECK(lineCount(refused.err) == 1);
    INFO(refused.err);
    CHECK_FALSE(std::ifstream(scene.path("out.csv")).good());
    std::smatch found;
    const std::regex pattern(
        "ball.vdb: .* voxels of about ([0-9.e-]+) and ask for ([0-9.e-]+), or allow a max_error of ([0-9.e-]+)\n");
    REQUIRE(std::regex_search(refused.err, found, pattern));
    CHECK(scene.collide("max_error = " + found[3].str()).exitCode == 0);
    scene.run("make sphere --center 0.01,0.02,0.03 --radius 1 --voxel " + found[1].str() + " -o " +
              scene.path("ball.vdb"));
    CHECK(scene.collide("max_error = " + found[2].str()).exitCode == 0);
}

TEST_CASE("what lookups are off by is kept beside the file until that changes")
{
    const BallScene scene;
    const std::string kept = scene.path("ball.vdb.accuracy");
    scene.report("max_error = \"0.05vx\"");
    const std::string first = contentOf(kept);
    REQUIRE_FALSE(first.empty());
    // That it is used: with another number in it, nothing suffices.
    std::ofstream(kept) << std::regex_replace(first, std::regex("resolution = [0-9.e-]+"), "resolution = 0.5");
    CHECK(scene.collide("max_error = \"0.05vx\"").exitCode == 4);
    for (const std::string& damaged : {first.substr(0, first.size() / 2), std::string("["), std::string()}) {
        std::ofstream(kept) << damaged;
        CHECK(scene.collide("max_error = \"0.05vx\"").exitCode == 0);
        CHECK(contentOf(kept) == first);
    }
    scene.run("make sphere --center 0,0,0 --radius 1 --voxel 0.125 -o " + scene.path("ball.vdb"));
    CHECK(scene.collide("max_error = \"0.1vx\"").exitCode == 0);
    CHECK(contentOf(kept) != first);
}

TEST_CASE("a wrong max_error is refused by name and line")
{
    const BallScene scene;
    const std::pair<const char*, const char*> wrong[] = {
        {"max_error = 0", "accuracy.max_error = 0 is out of range"},
        {"max_error = \"-1vx\"", "accuracy.max_error = -1 is out of range"},
        {"max_error = \"small\"", "accuracy.max_error"},
        {"max_error = 0.1\nlookup = \"cubic\"", "accuracy.lookup is chosen by max_error"},
    };
    for (const auto& [accuracy, what] : wrong) {
        const ToolRun refused = scene.collide(accuracy);
        INFO(accuracy << ": " << refused.err);
        CHECK(refused.exitCode == 3);
        CHECK(lineCount(refused.err) == 1);
        CHECK(refused.err.find(what) != std::string::npos);
        CHECK(refused.err.find("scene.toml:") != std::string::npos);
    }
}

TEST_CASE("max_error asks the level sets of sequences and blobs, and nothing of formulas")
{
    const BallScene scene;
    const Json formula = scene.report("max_error = 1e-9", "", "sphere = { center = [0, 0, 0], radius = 1 }");
    CHECK(formula["measured_error_vx"] == 0.0);
    for (int frame = 0; frame <= 2; ++frame) {
        scene.run("make sphere --center 0,0.0" + std::to_string(frame) + ",0 --radius 1 --voxel 0.0625 -o " +
                  scene.path("ball." + std::to_string(frame) + ".vdb"));
    }
    CHECK(scene.report("max_error = 0.0003", "", "sequence = \"ball.#.vdb\"")["chosen"]["lookup"] == "cubic");
    scene.run("emit box --min 0,0,0 --max 0.5,0.1,0.5 -n 20 -o " + scene.path("b.csv"));
    const std::string blobs = "blobs = { file = \"b.csv\", voxel = 0.05, radius = 0.2 }";
    const Json report = scene.report("max_error = \"0.5vx\"", "", blobs);
    CHECK(report["measured_error_vx"] > 0.0);
    CHECK(report["measured_error_vx"] < 0.5);
}

TEST_CASE("a sequence takes the same choice whichever of its frames are run")
{
    const BallScene scene;
    for (int frame = 0; frame <= 2; ++frame) {
        const std::string shape = frame == 0 ? "sphere --center 0,0,0 --radius 1" : "box --center 0,0,0 --half 1,1,1";
        scene.run("make " + shape + " --voxel 0.0625 -o " + scene.path("body." + std::to_string(frame) + ".vdb"));
    }
    const std::string file = "sequence = \"body.#.vdb\"";
    const Json whole = scene.report("max_error = \"0.05vx\"", "--set output.file=o.#.csv", file);
    const Json rest = scene.report("max_error = \"0.05vx\"", "--set output.file=o.#.csv --frames 1-2", file);
    CHECK(whole["chosen"] == rest["chosen"]);
    CHECK(whole["measured_error_vx"] == rest["measured_error_vx"]);
}

TEST_CASE("the plan tells what max_error chose, and refuses what a run refuses")
{
    const BallScene scene;
    const Json run = scene.report("max_error = \"0.05vx\"");
    const Json plan = scene.report("max_error = \"0.05vx\"", "--explain");
    CHECK(plan["chosen"] == run["chosen"]);
    CHECK(plan["measured_error_vx"] == run["measured_error_vx"]);
    const std::string usual = "max_error = \"0.05vx\"";
    CHECK(scene.collide(usual, "--explain --max-error 1e-9").exitCode == 4);
    CHECK(scene.collide(usual, "--explain --frames 3-2").exitCode == 2);
    CHECK(scene.collide(usual, "--explain --set output.file=p.csv").exitCode == 2);
    const std::string sphere = "sphere = { center = [0, 0, 0], radius = 1 }";
    CHECK(scene.collide(usual, "", sphere).exitCode == 2); // no voxels to measure in
}
