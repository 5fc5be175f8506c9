// SPDX-License-Identifier: Apache-2.0
#include "option_values.h"
#include "report.h"

#include "vdbounce/io/grid_file.h"
#include "vdbounce/io/particle_file.h"
#include "vdbounce/render/slice.h"

#include <memory>

namespace vdbounce::tool {
namespace {

struct SliceArguments {
    std::string field;
    std::string particles;
    std::string output;
    SliceOptions options;
    std::optional<Length> slab;
};

const std::map<std::string, int> kAxes = {{"x", 0}, {"y", 1}, {"z", 2}};

void runSlice(const SliceArguments& arguments, const CommonOptions& common)
{
    requireOutput(arguments.output, {"png"}, {arguments.field, arguments.particles});
    const DistanceField field(readLevelSet(arguments.field));
    const Particles particles = arguments.particles.empty() ? Particles{} : readParticles(arguments.particles);
    SliceOptions options = arguments.options;
    if (arguments.slab) options.slab = arguments.slab->world(field.voxelSize());
    const RgbImage image = renderSlice(field, particles, options);
    writePng(image, arguments.output);
    report(common, {{"output", arguments.output}, {"width", image.width}, {"height", image.height}},
           arguments.output + ": " + std::to_string(image.width) + "x" + std::to_string(image.height));
}

} // namespace

void addSlice(CLI::App& app, const CommonOptions& common)
{
    auto* verb =
        app.add_subcommand("slice", "Draw a cut through a level set: colours of phi, the zero line, particles");
    auto arguments = std::make_shared<SliceArguments>();
    verb->add_option("FIELD", arguments->field, "Level set, .vdb")->required();
    verb->add_option("-o,--output", arguments->output, "Picture to write, .png")->required();
    addChoice(*verb, "--axis", arguments->options.axis, kAxes, "The axis to cut across: x, y, z (default z)");
    verb->add_option("--at", arguments->options.at, "Where to cut it, world units; else in the middle")->type_name("D");
    verb->add_option("--particles", arguments->particles, "Particles to show near the cut");
    addLength(*verb, "--slab", arguments->slab, "How near (default 2vx)");
    verb->add_option("--size", arguments->options.size, "Pixels of the longer side")
        ->capture_default_str()
        ->type_name("N");
    verb->footer("Example:\n  vdbounce slice bunny.vdb --axis z -o slice.png");
    verb->callback([arguments, &common] { runWith(common, [&] { runSlice(*arguments, common); }); });
}

} // namespace vdbounce::tool
