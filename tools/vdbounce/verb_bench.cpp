// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_collide.h"
#include "bench/bench_field.h"
#include "bench_report.h"
#include "command_text.h"
#include "option_values.h"
#include "progress_bar.h"

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

// The mesh that comes with the sources.
constexpr const char* kBunny = "data/bunny.obj";

struct BenchArguments {
    std::vector<std::string> files;
    std::vector<std::uint64_t> points;
    std::uint64_t particles = 10'000'000;
    int repetitions = 3;
    std::string html;
};

std::string commandOfField(const BenchArguments& arguments)
{
    CommandText command("bench field");
    command.add(arguments.files);
    command.option("--points", arguments.points);
    command.option("--repetitions", arguments.repetitions);
    return command.text();
}

std::string commandOfCollide(const BenchArguments& arguments)
{
    CommandText command("bench collide");
    command.option("--particles", arguments.particles);
    command.option("--repetitions", arguments.repetitions);
    return command.text();
}

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

void runBenchField(const BenchArguments& arguments, const CommonOptions& common)
{
    requirePage(arguments.html, arguments.files);
    ProgressBar progress(common, "bench field");
    bench::FieldBenchOptions options;
    options.repetitions = arguments.repetitions;
    if (!arguments.points.empty()) options.points.assign(arguments.points.begin(), arguments.points.end());
    bench::Cases cases;
    for (const bench::FieldSubject& subject : subjectsOf(arguments, common, progress))
        append(cases, bench::benchField(subject, options, progress));
    reportRun(common, {commandOfField(arguments), casesJson(cases), casesText(cases)}, arguments.html);
}

void runBenchCollide(const BenchArguments& arguments, const CommonOptions& common)
{
    requirePage(arguments.html);
    ProgressBar progress(common, "bench collide");
    bench::CollideBenchOptions options;
    options.repetitions = arguments.repetitions;
    options.particles = arguments.particles;
    bench::Cases cases = bench::benchColumn(options, progress);
    if (std::filesystem::exists(kBunny)) {
        append(cases, bench::benchMeshBox("bunny", readMesh(kBunny), options, progress));
    } else {
        warn(common, std::string("the bunny is left out: there is no ") + kBunny + " here");
    }
    reportRun(common, {commandOfCollide(arguments), casesJson(cases), casesText(cases)}, arguments.html);
}

void addBenchField(CLI::App& bench, const CommonOptions& common)
{
    auto arguments = std::make_shared<BenchArguments>();
    auto* field = bench.add_subcommand("field", "Lookups of phi and gradient against OpenVDB's and NanoVDB's");
    field->add_option("FIELD", arguments->files,
                      "Level sets, .vdb; without any the sphere of radius 256 voxels and the dragon at 512");
    field->add_option("--points", arguments->points, "Points to look up (default 2000000 20000000)")
        ->check(CLI::Range(std::uint64_t(1000), std::uint64_t(1000000000)))
        ->type_name("N");
    addRepetitions(*field, arguments->repetitions);
    addHtml(*field, arguments->html);
    field->footer("Example:\n  vdbounce bench field bunny.vdb --points 2000000");
    field->callback([arguments, &common] { runWith(common, [&] { runBenchField(*arguments, common); }); });
}

void addBenchCollide(CLI::App& bench, const CommonOptions& common)
{
    auto arguments = std::make_shared<BenchArguments>();
    auto* collide =
        bench.add_subcommand("collide", "Steps of colliding particles against NanoVDB's example and bare movement");
    collide->add_option("--particles", arguments->particles, "Particles of each situation")
        ->check(CLI::Range(std::uint64_t(1000), std::uint64_t(1000000000)))
        ->capture_default_str()
        ->type_name("N");
    addRepetitions(*collide, arguments->repetitions);
    addHtml(*collide, arguments->html);
    collide->footer("Example:\n  vdbounce bench collide --particles 1000000");
    collide->callback([arguments, &common] { runWith(common, [&] { runBenchCollide(*arguments, common); }); });
}

} // namespace

void addBench(CLI::App& app, const CommonOptions& common)
{
    auto* verb = app.add_subcommand("bench", "Measure speed against other programs' libraries, in one run");
    verb->require_subcommand(1);
    verb->footer("Example:\n  vdbounce bench field --json");
    addBenchField(*verb, common);
    addBenchMesh(*verb, common);
    addBenchMake(*verb, common);
    addBenchTrade(*verb, common);
    addBenchCollide(*verb, common);
    addBenchAll(*verb, common);
}

} // namespace vdbounce::tool
