// SPDX-License-Identifier: Apache-2.0
#include "option_values.h"
#include "progress_bar.h"
#include "report.h"
#include "signals.h"
#include "stopwatch.h"

#include "vdbounce/implicit/blobs.h"
#include "vdbounce/io/grid_file.h"
#include "vdbounce/io/particle_file.h"

#include <memory>

namespace vdbounce::tool {
namespace {

constexpr const char* kVerb = "vdbounce blobs";

const std::map<std::string, BlobKernel> kKernels = {
    {"gaussian", BlobKernel::Gaussian}, {"compact", BlobKernel::Compact}, {"sphere", BlobKernel::Sphere}};

struct BlobsArguments {
    std::string input;
    std::string output;
    BlobOptions options;
    std::optional<Length> voxel;
    std::optional<Length> band;
    bool half = false;
};

void requireSound(const BlobsArguments& arguments, bool strengthGiven)
{
    const auto require = [](bool good, const char* what, const char* remedy) {
        if (!good) throw UsageError(kVerb, what, remedy);
    };
    require(!arguments.voxel->inVoxels, "--voxel is a length in world units", "give for example --voxel 0.1");
    const bool spheres = arguments.options.kernel == BlobKernel::Sphere;
    require(!spheres || (!arguments.options.threshold && !strengthGiven),
            "--threshold and --strength say nothing with --kernel sphere", "leave them out, or use another kernel");
    requireParticleFile(arguments.input);
    requireOutput(arguments.output, {"vdb"}, {arguments.input});
}

void runBlobs(BlobsArguments arguments, const CommonOptions& common)
{
    BlobOptions& options = arguments.options;
    options.voxelSize = arguments.voxel->value;
    if (arguments.band) options.halfWidthVx = arguments.band->voxels(options.voxelSize);
    endAtOnceWhenInterrupted(); // all that is written is written at the end
    Stopwatch watch;
    const Particles particles = readParticles(arguments.input);
    const double readSeconds = watch.lap();
    BlobResult result;
    {
        ProgressBar progress(common, "blobs");
        result = makeBlobs(particles, options, progress);
    }
    const double buildSeconds = watch.lap();
    for (const std::string& warning : result.warnings) warn(common, arguments.input + ": " + warning);
    GridWriteOptions writing;
    writing.half = arguments.half;
    writeLevelSet(result.grid, arguments.output, writing);
    const double writeSeconds = watch.lap();
    const LevelSetSummary summary = summarize(result.grid);
    report(common,
           {{"output", arguments.output},
            {"particles", result.particles},
            {"left_out", {{"not_finite", result.notFinite}, {"no_radius", result.noRadius}}},
            {"without_surface", result.tooSmall},
            {"voxel_size", options.voxelSize},
            {"active_voxels", summary.activeVoxels},
            {"warnings", result.warnings},
            {"seconds", {{"read", readSeconds}, {"build", buildSeconds}, {"write", writeSeconds}}}},
           arguments.output + ": " + counted(result.particles, "particle") + ", voxel " + rounded(options.voxelSize) +
               ", " + grouped(summary.activeVoxels) + " active voxels, " + rounded(readSeconds + buildSeconds) + " s");
}

} // namespace

void addBlobs(CLI::App& app, const CommonOptions& common)
{
    auto* verb = app.add_subcommand("blobs", "Turn particles into the level set of a surface around them");
    auto arguments = std::make_shared<BlobsArguments>();
    BlobOptions& options = arguments->options;
    verb->add_option("PARTICLES", arguments->input, "Particles: .vdb, .csv or .ply")->required();
    verb->add_option("-o,--output", arguments->output, "Level set to write, .vdb")->required();
    addLength(*verb, "--voxel", arguments->voxel, "Voxel size, world units")->required();
    addChoice(*verb, "--kernel", options.kernel, kKernels,
              "What a particle adds: gaussian exp(-x^2), compact (1-x^2/4)^3, x being the distance over its radius; or "
              "sphere, for the union of the particles as balls (default gaussian)");
    verb->add_option("--threshold", options.threshold,
                     "The surface lies where the sum is this (default the kernel at x = 1, so that a lone particle's "
                     "surface is at its radius)")
        ->type_name("T");
    addLength(*verb, "--radius", options.radius, "Radius of the particles where the file carries none");
    auto* strength = verb->add_option("--strength", options.strength, "What every particle's kernel is multiplied with")
                         ->capture_default_str()
                         ->type_name("A");
    addLength(*verb, "--band", arguments->band, "Half width of the narrow band on both sides (default 3vx)");
    addBytes(*verb, "--max-memory", options.maxMemory,
             "Refuse what would need more (default three quarters of the machine's)");
    verb->add_option("--name", options.gridName, "Name of the grid")->capture_default_str();
    verb->add_flag("--half", arguments->half, "Store values as 16-bit floats");
    verb->footer(
        "Inside overlapping spheres phi is no farther than the surface; 'vdbounce redistance' makes it exact.\n"
        "Example:\n  vdbounce blobs cloud.vdb -o liquid.vdb --voxel 0.05 --radius 2vx");
    verb->callback([arguments, strength, &common] {
        runWith(common, [&] {
            requireSound(*arguments, strength->count() > 0);
            runBlobs(*arguments, common);
        });
    });
}

} // namespace vdbounce::tool
