// SPDX-License-Identifier: Apache-2.0
#include "option_values.h"
#include "report.h"
#include "signals.h"

#include "vdbounce/build/emit.h"
#include "vdbounce/io/grid_file.h"
#include "vdbounce/io/particle_file.h"

#include <memory>

namespace vdbounce::tool {
namespace {

struct EmitArguments {
    EmitOptions options;
    std::string output;
    Box box;
    Vec3d centre = Vec3d::Zero();
    double ballRadius = 1.0;
    std::string field;
    std::optional<Length> offset;
};

void finish(const Particles& particles, const EmitArguments& arguments, const CommonOptions& common)
{
    throwIfInterrupted();
    writeParticles(particles, arguments.output);
    report(common, {{"output", arguments.output}, {"particles", particles.size()}, {"seed", arguments.options.seed}},
           arguments.output + ": " + grouped(particles.size()) + " particles");
}

Particles emitFromSurface(const EmitArguments& arguments)
{
    const DistanceField field(readLevelSet(arguments.field));
    return emitOnSurface(field, arguments.offset.value_or(Length{}).world(field.voxelSize()), arguments.options);
}

// `radiusName` is how the particles' radius is called; for a sphere --radius is the ball's own.
void addEmitted(CLI::App& where, EmitArguments& arguments, const std::string& radiusName)
{
    EmitOptions& options = arguments.options;
    addCount(where, "-n,--count", options.count, "Number of particles; 1e6 is one")->required();
    where.add_option("-o,--output", arguments.output, "Particles to write: .vdb, .csv or .ply")->required();
    where.add_option("--seed", options.seed, "Equal seeds give equal particles")->capture_default_str()->type_name("N");
    addVector(where, "--velocity", options.velocity, "Velocity of every particle");
    where.add_option(radiusName, options.radius, "Radius of every particle, world units")->type_name("R");
    where.add_option("--mass", options.mass, "Mass of every particle")->type_name("M");
}

} // namespace

void addEmit(CLI::App& app, const CommonOptions& common)
{
    auto* verb = app.add_subcommand("emit", "Make particles in a box, in a ball or on a surface");
    verb->require_subcommand(1);
    verb->footer("Example:\n  vdbounce emit box --min -1,2,-1 --max 1,3,1 -n 1000000 -o cloud.vdb");
    auto arguments = std::make_shared<EmitArguments>();

    auto* box = verb->add_subcommand("box", "Evenly in a box");
    addVector(*box, "--min", arguments->box.min, "Lower corner")->required();
    addVector(*box, "--max", arguments->box.max, "Upper corner")->required();
    addEmitted(*box, *arguments, "--radius,--particle-radius");
    box->callback([arguments, &common] {
        runWith(common, [&] {
            requireOutput(arguments->output, {"vdb", "csv", "ply"}, {arguments->field});
            finish(emitInBox(arguments->box, arguments->options), *arguments, common);
        });
    });

    auto* sphere = verb->add_subcommand("sphere", "Evenly in a ball");
    addVector(*sphere, "--center", arguments->centre, "Centre of the ball")->required();
    sphere->add_option("--radius", arguments->ballRadius, "Radius of the ball, world units")
        ->required()
        ->type_name("R");
    addEmitted(*sphere, *arguments, "--particle-radius");
    sphere->callback([arguments, &common] {
        runWith(common, [&] {
            requireOutput(arguments->output, {"vdb", "csv", "ply"}, {arguments->field});
            finish(emitInSphere(arguments->centre, arguments->ballRadius, arguments->options), *arguments, common);
        });
    });

    auto* surface = verb->add_subcommand("surface", "On the surface of a level set");
    surface->add_option("FIELD", arguments->field, "Level set, .vdb")->required();
    addLength(*surface, "--offset", arguments->offset, "Distance from the surface, within the band (default 0)");
    addEmitted(*surface, *arguments, "--radius,--particle-radius");
    surface->callback([arguments, &common] {
        runWith(common, [&] {
            requireOutput(arguments->output, {"vdb", "csv", "ply"}, {arguments->field});
            finish(emitFromSurface(*arguments), *arguments, common);
        });
    });
    const char* const examples[][2] = {
        {"box", "vdbounce emit box --min -1,2,-1 --max 1,3,1 -n 1000 -o cloud.csv"},
        {"sphere", "vdbounce emit sphere --center 0,2,0 --radius 0.5 -n 1000 -o ball.csv"},
        {"surface", "vdbounce emit surface bunny.vdb --offset 1vx -n 1000 -o skin.csv"}};
    for (const auto& example : examples)
        verb->get_subcommand(example[0])->footer(std::string("Example:\n  ") + example[1]);
}

} // namespace vdbounce::tool
