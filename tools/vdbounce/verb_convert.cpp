// SPDX-License-Identifier: Apache-2.0
#include "option_values.h"
#include "report.h"
#include "signals.h"

#include "vdbounce/io/particle_file.h"

#include <memory>

namespace vdbounce::tool {
namespace {

struct ConvertArguments {
    std::string input;
    std::string output;
};

void runConvert(const ConvertArguments& arguments, const CommonOptions& common)
{
    requireOutput(arguments.output, {"vdb", "csv", "ply"}, {arguments.input});
    const Particles particles = readParticles(arguments.input);
    throwIfInterrupted();
    writeParticles(particles, arguments.output);
    report(common, {{"output", arguments.output}, {"particles", particles.size()}},
           arguments.output + ": " + grouped(particles.size()) + " particles");
}

} // namespace

void addConvert(CLI::App& app, const CommonOptions& common)
{
    auto* verb = app.add_subcommand("convert", "Convert particles between file formats");
    auto arguments = std::make_shared<ConvertArguments>();
    verb->add_option("IN", arguments->input, "Particles: .vdb, .csv or .ply")->required();
    verb->add_option("OUT", arguments->output, "Particles to write: .vdb, .csv or .ply")->required();
    verb->footer("Example:\n  vdbounce convert cloud.vdb cloud.csv");
    verb->callback([arguments, &common] { runWith(common, [&] { runConvert(*arguments, common); }); });
}

} // namespace vdbounce::tool
