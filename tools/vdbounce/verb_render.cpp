// SPDX-License-Identifier: Apache-2.0
#include "option_values.h"
#include "progress_bar.h"
#include "report.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/file_bytes.h"
#include "vdbounce/io/grid_file.h"
#include "vdbounce/io/particle_file.h"
#include "vdbounce/render/picture.h"

#include <memory>

namespace vdbounce::tool {
namespace {

struct RenderArguments {
    std::vector<std::string> files;
    std::string output;
    PictureOptions options;
    std::optional<Vec3d> frameMin;
    std::optional<Vec3d> frameMax;
};

// What a file has to draw; a .vdb may hold points and a level set both.
struct Drawables {
    bool points = false;
    bool surface = false;
};

Drawables drawablesOf(const std::string& path)
{
    if (fileEnding(path) != "vdb") return {true, false};
    Drawables found;
    for (const GridEntry& grid : listGrids(path)) (grid.isPoints ? found.points : found.surface) = true;
    return found;
}

void append(Particles& all, const Particles& more)
{
    if (all.empty()) {
        all = more;
        return;
    }
    // Pictures need positions, speeds and radii; a file without speeds is at rest.
    const std::size_t before = all.size();
    all.ensureVelocity();
    if (all.radius.empty() != more.radius.empty()) all.radius.resize(before, 0.0);
    all.resize(before + more.size());
    for (std::size_t i = 0; i < more.size(); ++i) {
        all.position[before + i] = more.position[i];
        if (!more.velocity.empty()) all.velocity[before + i] = more.velocity[i];
        if (!more.radius.empty()) all.radius[before + i] = more.radius[i];
    }
}

void runRender(const RenderArguments& arguments, const CommonOptions& common)
{
    requireOutput(arguments.output, {"png"}, arguments.files);
    std::vector<std::shared_ptr<const DistanceField>> fields;
    Particles particles;
    for (const std::string& file : arguments.files) {
        const Drawables has = drawablesOf(file);
        if (has.points) append(particles, readParticles(file));
        if (has.surface || !has.points) fields.push_back(std::make_shared<const DistanceField>(readLevelSet(file)));
    }
    PictureOptions options = arguments.options;
    if (arguments.frameMin.has_value() != arguments.frameMax.has_value())
        throw UsageError("--frame-min, --frame-max", "only one is given", "give both or none");
    if (arguments.frameMin) options.frame = Box{*arguments.frameMin, *arguments.frameMax};
    ProgressBar progress(common, "render");
    const RgbImage image = renderPicture(fields, particles, options, progress);
    writePng(image, arguments.output);
    report(common,
           {{"output", arguments.output},
            {"width", image.width},
            {"height", image.height},
            {"level_sets", fields.size()},
            {"particles", particles.size()}},
           arguments.output + ": " + std::to_string(image.width) + "x" + std::to_string(image.height) + ", " +
               grouped(particles.size()) + " particles");
}

} // namespace

void addRender(CLI::App& app, const CommonOptions& common)
{
    auto* verb = app.add_subcommand("render", "Draw level sets, shaded, with particles over them");
    auto arguments = std::make_shared<RenderArguments>();
    verb->add_option("FILES", arguments->files, "Level sets (.vdb) and particles (.vdb, .csv, .ply)")->required();
    verb->add_option("-o,--output", arguments->output, "Picture to write, .png")->required();
    addPixels(*verb, "--size", arguments->options.width, arguments->options.height, "Pixels (default 1280x960)");
    addVector(*verb, "--view", arguments->options.view, "Direction towards the eye (default 0.5,0.4,1)");
    addVector(*verb, "--up", arguments->options.up, "Upwards (default 0,1,0)");
    verb->add_option("--ground", arguments->options.ground, "Height of a floor, along --up")->type_name("H");
    verb->add_option("--particle-radius", arguments->options.particleRadius,
                     "How large to draw particles, world units; else their own radius or one that suits their number")
        ->check(CLI::NonNegativeNumber)
        ->type_name("R");
    addVector(*verb, "--frame-min", arguments->frameMin, "Lower corner of what to show; else all level sets");
    addVector(*verb, "--frame-max", arguments->frameMax, "Upper corner of what to show");
    verb->footer("Example:\n  vdbounce render bunny.vdb out.0048.vdb --ground 0 -o picture.png");
    verb->callback([arguments, &common] { runWith(common, [&] { runRender(*arguments, common); }); });
}

} // namespace vdbounce::tool
