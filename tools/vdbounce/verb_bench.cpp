// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_field.h"
#include "bench/machine.h"
#include "option_values.h"
#include "progress_bar.h"
#include "report.h"

#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/io/grid_file.h"
#include "vdbounce/io/mesh_file.h"

#include <filesystem>
#include <memory>

namespace vdbounce::tool {
namespace {

// The dragon that ./dev data fetches, and how many voxels long it is measured.
constexpr const char* kDragon = "data/fetched/dragon_vrip.ply";
constexpr int kDragonDim = 512;

struct BenchArguments {
    std::vector<std::string> files;
    std::vector<std::uint64_t> points;
    int repetitions = 3;
};

bench::FieldSubject dragonSubject(ProgressBar& progress)
{
    const TriangleMesh mesh = readMesh(kDragon);
    MeshToLevelSetOptions options;
    options.voxelSize = boundingBox(mesh).size().maxCoeff() / kDragonDim;
    return {"dragon at 512", meshToLevelSet(mesh, options, progress).grid};
}

std::vector<bench::FieldSubject> subjectsOf(const BenchArguments& arguments, const CommonOptions& common,
                                            ProgressBar& progress)
{
    std::vector<bench::FieldSubject> subjects;
    for (const std::string& file : arguments.files) subjects.push_back({file, readLevelSet(file)});
    if (!subjects.empty()) return subjects;
    subjects.push_back(bench::sphereSubject());
    if (std::filesystem::exists(kDragon)) {
        subjects.push_back(dragonSubject(progress));
    } else {
        warn(common, std::string("the dragon is left out: there is no ") + kDragon + "; ./dev data fetches it");
    }
    return subjects;
}

Json toJson(const bench::Case& result)
{
    Json json = {{"name", result.name}, {"unit", result.unit}, {"value", result.value}};
    if (result.peer) {
        json["peer"] = {{"name", result.peer->name}, {"value", result.peer->value}};
        json["ratio"] = result.ratio();
    }
    return json;
}

std::string toText(const bench::Case& result)
{
    std::string text = result.name + ": " + rounded(result.value) + " " + result.unit;
    if (result.peer) {
        text += "; " + result.peer->name + " " + rounded(result.peer->value) + ", ratio " + rounded(result.ratio());
    }
    return text;
}

void runBenchField(const BenchArguments& arguments, const CommonOptions& common)
{
    ProgressBar progress(common, "bench field");
    bench::FieldBenchOptions options;
    options.repetitions = arguments.repetitions;
    if (!arguments.points.empty()) options.points.assign(arguments.points.begin(), arguments.points.end());
    Json json = {{"machine", bench::machineText()}, {"cases", Json::array()}};
    std::string text = json["machine"].get<std::string>();
    for (const bench::FieldSubject& subject : subjectsOf(arguments, common, progress)) {
        for (const bench::Case& result : bench::benchField(subject, options, progress)) {
            json["cases"].push_back(toJson(result));
            text += "\n" + toText(result);
        }
    }
    report(common, json, text);
}

} // namespace

void addBench(CLI::App& app, const CommonOptions& common)
{
    auto* verb = app.add_subcommand("bench", "Measure speed against other programs' libraries, in one run");
    verb->require_subcommand(1);
    verb->footer("Example:\n  vdbounce bench field --json");
    auto arguments = std::make_shared<BenchArguments>();
    auto* field = verb->add_subcommand("field", "Lookups of phi and gradient against OpenVDB's and NanoVDB's");
    field->add_option("FIELD", arguments->files,
                      "Level sets, .vdb; without any the sphere of radius 256 voxels and the dragon at 512");
    field->add_option("--points", arguments->points, "Points to look up (default 2000000 20000000)")
        ->check(CLI::Range(std::uint64_t(1000), std::uint64_t(1000000000)))
        ->type_name("N");
    field->add_option("--repetitions", arguments->repetitions, "Runs, of which the median is printed")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str()
        ->type_name("N");
    field->footer("Example:\n  vdbounce bench field bunny.vdb --points 2000000");
    field->callback([arguments, &common] { runWith(common, [&] { runBenchField(*arguments, common); }); });
}

} // namespace vdbounce::tool
