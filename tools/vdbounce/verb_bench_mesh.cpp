// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_mesh.h"
#include "bench/thread_counts.h"
#include "bench_report.h"
#include "command_text.h"
#include "mesh_bench_table.h"
#include "option_values.h"
#include "progress_bar.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/mesh_file.h"

#include <algorithm>
#include <filesystem>
#include <memory>

namespace vdbounce::tool {
namespace {

namespace fs = std::filesystem;

// The mesh that comes with the sources, and the folder of those that ./dev data fetches.
constexpr const char* kBunny = "data/bunny.obj";
constexpr const char* kFetched = "data/fetched";

// The largest mesh that is fetched.
constexpr const char* kDragon = "dragon_vrip.ply";

// So that all meshes together take minutes: few triangles a voxel and many, one grid that is large besides, and the
// dragon only where its triangles are about as large as voxels.
const std::vector<int> kDims = {128, 512};
const std::vector<int> kBunnyDims = {128, 512, 1024};
const std::vector<int> kDragonDims = {512};

struct BenchMeshArguments {
    std::vector<std::string> files;
    std::vector<int> dims;
    double bandVx = 3.0;
    int repetitions = 3;
    std::string html;
};

std::string commandOf(const BenchMeshArguments& arguments)
{
    CommandText command("bench mesh");
    command.add(arguments.files);
    command.option("--dim", arguments.dims);
    command.option("--band", arguments.bandVx);
    command.option("--repetitions", arguments.repetitions);
    return command.text();
}

// A part of a run in several parts, all of which the bar counts as equally long.
class PartProgress : public Progress {
public:
    PartProgress(Progress& whole, std::size_t parts) : whole_(whole), parts_(parts) {}

    void update(std::uint64_t done, std::uint64_t total) override
    {
        whole_.update(finished_ * total + done, parts_ * total);
    }
    bool stopRequested() const override { return whole_.stopRequested(); }
    void nextPart() { ++finished_; }

private:
    Progress& whole_;
    std::uint64_t parts_;
    std::uint64_t finished_ = 0;
};

std::vector<std::string> defaultFiles(const CommonOptions& common)
{
    std::vector<std::string> files;
    if (fs::is_directory(kFetched)) {
        for (const auto& entry : fs::directory_iterator(kFetched)) {
            if (isMeshFile(entry.path().string())) files.push_back(entry.path().string());
        }
        std::sort(files.begin(), files.end());
    } else {
        warn(common, std::string("larger meshes are left out: there is no ") + kFetched + "; ./dev data fetches them");
    }
    if (fs::exists(kBunny)) files.insert(files.begin(), kBunny);
    if (files.empty())
        throw UsageError("vdbounce bench mesh", std::string("there is no ") + kBunny + " here", "name a mesh");
    return files;
}

std::vector<int> dimsFor(const BenchMeshArguments& arguments, const std::string& file)
{
    if (!arguments.dims.empty()) return arguments.dims;
    const fs::path path(file);
    if (path.filename() == kDragon) return kDragonDims;
    return path.filename() == fs::path(kBunny).filename() ? kBunnyDims : kDims;
}

void runBenchMesh(const BenchMeshArguments& arguments, const CommonOptions& common)
{
    requirePage(arguments.html, arguments.files);
    const std::vector<std::string> files = arguments.files.empty() ? defaultFiles(common) : arguments.files;
    std::size_t parts = 0;
    for (const std::string& file : files) parts += dimsFor(arguments, file).size();

    std::vector<bench::MeshBenchResult> results;
    bench::Cases cases;
    {
        ProgressBar bar(common, "bench mesh");
        PartProgress progress(bar, parts);
        for (const std::string& file : files) {
            const TriangleMesh mesh = readMesh(file);
            for (int dim : dimsFor(arguments, file)) {
                const bench::MeshBenchOptions options{dim, arguments.bandVx, arguments.repetitions};
                results.push_back(bench::benchMesh(fs::path(file).filename().string(), mesh, options, progress));
                append(cases, bench::casesOf(results.back()));
                progress.nextPart();
            }
        }
    }
    const std::string text = "meshToLevelSet and OpenVDB's meshToVolume, band " + rounded(arguments.bandVx) +
                             " voxels, " + bench::threadsText() + ", medians of " +
                             std::to_string(arguments.repetitions) +
                             "; ratio is OpenVDB's processor time over ours\n\n" + meshBenchTable(results);
    reportRun(common, {commandOf(arguments), casesJson(cases), text}, arguments.html);
}

} // namespace

void addBenchMesh(CLI::App& bench, const CommonOptions& common)
{
    auto arguments = std::make_shared<BenchMeshArguments>();
    auto* mesh = bench.add_subcommand("mesh", "Level sets of meshes against OpenVDB's meshToVolume");
    mesh->add_option("MESH", arguments->files,
                     "Meshes: .obj, .stl, .ply or .off; without any the bunny and all in data/fetched");
    mesh->add_option("--dim", arguments->dims,
                     "Voxels on the longest side of each mesh's box (default 128 512, the bunny also 1024, the dragon "
                     "only 512)")
        ->check(CLI::Range(1, 1000000))
        ->type_name("N");
    mesh->add_option("--band", arguments->bandVx, "Half width of the narrow band on both sides, voxels")
        ->check(CLI::Range(1.0, 1000.0))
        ->capture_default_str()
        ->type_name("W");
    addRepetitions(*mesh, arguments->repetitions);
    addHtml(*mesh, arguments->html);
    mesh->footer("Example:\n  vdbounce bench mesh bunny.obj --dim 128 512");
    mesh->callback([arguments, &common] { runWith(common, [&] { runBenchMesh(*arguments, common); }); });
}

} // namespace vdbounce::tool
