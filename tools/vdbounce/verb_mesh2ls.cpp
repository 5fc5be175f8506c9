// SPDX-License-Identifier: Apache-2.0
#include "option_values.h"
#include "progress_bar.h"
#include "report.h"

#include "vdbounce/base/error.h"
#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/build/verify_level_set.h"
#include "vdbounce/io/grid_file.h"
#include "vdbounce/io/mesh_file.h"

#include <chrono>
#include <memory>

namespace vdbounce::tool {
namespace {

struct Mesh2lsArguments {
    std::string input;
    std::string output;
    std::optional<Length> voxel;
    std::optional<int> dim;
    std::optional<Length> band;
    std::optional<Length> exterior;
    std::optional<Length> interior;
    std::optional<Length> thickness;
    SignMethod sign = SignMethod::Auto;
    std::string name = "surface";
    bool half = false;
    bool verify = false;
    std::optional<Length> tolerance;
};

const std::map<std::string, SignMethod> kSignMethods = {{"auto", SignMethod::Auto},
                                                        {"winding", SignMethod::Winding},
                                                        {"parity", SignMethod::Parity},
                                                        {"flood", SignMethod::Flood},
                                                        {"unsigned", SignMethod::Unsigned}};

double voxelSizeFor(const Mesh2lsArguments& arguments, const TriangleMesh& mesh)
{
    if (arguments.voxel) {
        if (arguments.voxel->inVoxels) throw UsageError("--voxel", "is given in voxels", "give it in world units");
        if (!(arguments.voxel->value > 0.0)) throw UsageError("--voxel", "is not positive", "give a length above 0");
        return arguments.voxel->value;
    }
    const double longest = boundingBox(mesh).size().maxCoeff();
    if (!(longest > 0.0))
        throw InputError(arguments.input, "all its points are in one place, so --dim says nothing", "give --voxel");
    return longest / *arguments.dim;
}

MeshToLevelSetOptions optionsFor(const Mesh2lsArguments& arguments, double voxelSize)
{
    MeshToLevelSetOptions options;
    options.voxelSize = voxelSize;
    options.sign = arguments.sign;
    options.gridName = arguments.name;
    if (arguments.band) options.exteriorVx = options.interiorVx = arguments.band->voxels(voxelSize);
    if (arguments.exterior) options.exteriorVx = arguments.exterior->voxels(voxelSize);
    if (arguments.interior) options.interiorVx = arguments.interior->voxels(voxelSize);
    if (arguments.thickness) options.thicknessVx = arguments.thickness->voxels(voxelSize);
    return options;
}

double secondsSince(std::chrono::steady_clock::time_point& mark)
{
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - mark).count();
    mark = now;
    return seconds;
}

void verify(const Mesh2lsArguments& arguments, const TriangleMesh& mesh, const MeshToLevelSetResult& result,
            const MeshToLevelSetOptions& options, Json& json, std::string& text)
{
    VerifyOptions verifyOptions;
    verifyOptions.sign = options.sign;
    verifyOptions.thickness = options.thicknessVx * options.voxelSize;
    verifyOptions.half = arguments.half;
    const VerifyReport report = verifyLevelSet(result.grid, mesh, verifyOptions);
    json["verify"] = {{"samples", report.samples},
                      {"max_error_vx", report.maxErrorVx},
                      {"rms_error_vx", report.rmsErrorVx},
                      {"sign_errors", report.signErrors}};
    text += "\nverified " + grouped(report.samples) + " voxels: largest error " + rounded(report.maxErrorVx) +
            " voxels, rms " + rounded(report.rmsErrorVx) + ", " + grouped(report.signErrors) + " signs wrong";
    if (!arguments.tolerance) return;
    const double allowed = arguments.tolerance->voxels(options.voxelSize);
    if (report.maxErrorVx > allowed || report.signErrors > 0) {
        throw ToleranceError(arguments.output,
                             "largest error " + rounded(report.maxErrorVx) + "vx and " + grouped(report.signErrors) +
                                 " wrong signs, beyond --tolerance " + rounded(allowed) + "vx",
                             "nothing was written; allow more or use another --sign");
    }
}

void runMesh2ls(const Mesh2lsArguments& arguments, const CommonOptions& common)
{
    if (arguments.voxel.has_value() == arguments.dim.has_value()) {
        throw UsageError("vdbounce mesh2ls", "exactly one of --voxel and --dim is needed",
                         "give for example --dim 128");
    }
    if (arguments.band && (arguments.exterior || arguments.interior)) {
        throw UsageError("vdbounce mesh2ls", "--band excludes --exterior and --interior", "give one or the other");
    }
    requireOutput(arguments.output, {"vdb"}, {arguments.input});
    auto mark = std::chrono::steady_clock::now();
    const TriangleMesh mesh = readMesh(arguments.input);
    const double readSeconds = secondsSince(mark);

    ProgressBar progress(common, "mesh2ls");
    const double voxelSize = voxelSizeFor(arguments, mesh);
    const MeshToLevelSetOptions options = optionsFor(arguments, voxelSize);
    const MeshToLevelSetResult result = meshToLevelSet(mesh, options, progress);
    const double buildSeconds = secondsSince(mark);

    const LevelSetSummary summary = summarize(result.grid);
    Json json = {{"output", arguments.output},
                 {"triangles", mesh.triangles.size()},
                 {"voxel_size", voxelSize},
                 {"active_voxels", summary.activeVoxels},
                 {"sign", signMethodName(result.sign)},
                 {"warnings", result.warnings}};
    std::string text = arguments.output + ": " + grouped(mesh.triangles.size()) + " triangles, voxel " +
                       rounded(voxelSize) + ", " + grouped(summary.activeVoxels) + " active voxels, sign by " +
                       signMethodName(result.sign) + ", " + rounded(readSeconds + buildSeconds) + " s";
    for (const std::string& warning : result.warnings) warn(common, arguments.input + ": " + warning);
    if (arguments.verify || arguments.tolerance) verify(arguments, mesh, result, options, json, text);
    throwIfStopped(progress);

    mark = std::chrono::steady_clock::now();
    writeLevelSet(result.grid, arguments.output, {arguments.half, {result.closest, result.confidence}});
    json["seconds"] = {{"read", readSeconds}, {"build", buildSeconds}, {"write", secondsSince(mark)}};
    report(common, json, text);
}

} // namespace

void addMesh2ls(CLI::App& app, const CommonOptions& common)
{
    auto* verb = app.add_subcommand("mesh2ls", "Turn a triangle mesh into a level set");
    auto arguments = std::make_shared<Mesh2lsArguments>();
    verb->add_option("IN", arguments->input, "Mesh: .obj, .stl, .ply or .off")->required();
    verb->add_option("-o,--output", arguments->output, "Level set to write, .vdb")->required();
    addLength(*verb, "--voxel", arguments->voxel, "Voxel size, world units");
    verb->add_option("--dim", arguments->dim, "Voxels on the longest side of the mesh's box")
        ->check(CLI::Range(1, 1000000))
        ->type_name("N");
    addLength(*verb, "--band", arguments->band, "Half width of the narrow band on both sides (default 3vx)");
    addLength(*verb, "--exterior", arguments->exterior, "Half width outside");
    addLength(*verb, "--interior", arguments->interior, "Half width inside");
    addChoice(*verb, "--sign", arguments->sign, kSignMethods,
              "How inside is told from outside: auto, winding, parity, flood, unsigned");
    addLength(*verb, "--thickness", arguments->thickness,
              "Thickness of the sheet that --sign unsigned makes (default 2vx)");
    verb->add_option("--name", arguments->name, "Name of the grid")->capture_default_str();
    verb->add_flag("--half", arguments->half, "Store values as 16-bit floats");
    verb->add_flag("--verify", arguments->verify, "Compare the result with exact distances");
    addLength(*verb, "--tolerance", arguments->tolerance,
              "With the comparison: exit 4 when off by more, and write nothing");
    verb->footer("Example:\n  vdbounce mesh2ls bunny.obj -o bunny.vdb --dim 128");
    verb->callback([arguments, &common] { runWith(common, [&] { runMesh2ls(*arguments, common); }); });
}

} // namespace vdbounce::tool
