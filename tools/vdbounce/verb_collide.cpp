// SPDX-License-Identifier: Apache-2.0
#include "collide_report.h"
#include "option_values.h"
#include "progress_bar.h"
#include "report.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/number_text.h"
#include "vdbounce/scene/scene_file.h"

#include <filesystem>
#include <memory>

namespace vdbounce::tool {
namespace {

struct CollideArguments {
    std::string sceneFile;
    std::vector<std::string> overrides;
    std::string frames;
    bool explain = false;
    bool strict = false;
    std::optional<Length> maxError;
    // The quick form.
    std::vector<std::string> colliders;
    std::string particles;
    std::string output;
    std::optional<double> dt;
    std::optional<int> steps;
    std::optional<Vec3d> gravity;
    std::optional<double> restitution;
    std::optional<double> friction;
    std::optional<Length> radius;
};

bool hasQuickOptions(const CollideArguments& a)
{
    return !a.colliders.empty() || !a.particles.empty() || !a.output.empty() || a.dt || a.steps || a.gravity ||
           a.restitution || a.friction || a.radius;
}

Scene quickScene(const CollideArguments& a)
{
    if (a.colliders.empty() || a.particles.empty() || a.output.empty() || !a.steps) {
        throw UsageError("vdbounce collide",
                         "neither a scene nor all of --collider, --particles, -o and --steps are given",
                         "see 'vdbounce collide --help'");
    }
    Scene scene;
    scene.particleFile = a.particles;
    scene.outputFile = a.output;
    scene.dt = a.dt.value_or(scene.dt);
    scene.gravity = a.gravity.value_or(scene.gravity);
    scene.radius = a.radius.value_or(scene.radius);
    // Each step is a frame where frames are asked for.
    scene.frames = hasFramePattern(a.output) ? *a.steps : 1;
    scene.stepsPerFrame = hasFramePattern(a.output) ? 1 : *a.steps;
    for (const std::string& file : a.colliders) {
        ColliderSpec collider;
        collider.name = std::filesystem::path(file).stem().string();
        collider.file = file;
        collider.restitution = a.restitution.value_or(collider.restitution);
        collider.friction = a.friction.value_or(collider.friction);
        scene.colliders.push_back(collider);
    }
    return scene;
}

Scene sceneFor(const CollideArguments& arguments)
{
    if (arguments.sceneFile.empty()) {
        if (!arguments.overrides.empty()) {
            throw UsageError("--set", "changes a scene, and none is given",
                             "name a scene file or use the options of the quick form");
        }
        return quickScene(arguments);
    }
    if (hasQuickOptions(arguments)) {
        throw UsageError("vdbounce collide",
                         "a scene file excludes --collider, --particles, -o and the other options of the quick form",
                         "use --set KEY=VALUE to change a scene");
    }
    return readScene(arguments.sceneFile, arguments.overrides);
}

RunOptions runOptions(const CollideArguments& arguments)
{
    RunOptions options;
    options.strict = arguments.strict;
    if (arguments.frames.empty()) return options;
    const std::size_t dash = arguments.frames.find('-');
    const auto first = parseInteger(std::string_view(arguments.frames).substr(0, dash));
    const auto last =
        dash == std::string::npos ? std::nullopt : parseInteger(std::string_view(arguments.frames).substr(dash + 1));
    if (!first || !last || *first < 0 || *last < *first || *last > 1000000000) {
        throw UsageError("--frames", "'" + arguments.frames + "' is no range of frames", "give FIRST-LAST, as in 0-24");
    }
    options.firstFrame = int(*first);
    options.lastFrame = int(*last);
    return options;
}

void runCollide(const CollideArguments& arguments, const CommonOptions& common)
{
    Scene scene = sceneFor(arguments);
    if (arguments.maxError) scene.maxError = arguments.maxError;
    if (!scene.outputFile.empty()) requireOutput(scene.outputFile, {"vdb", "csv", "ply"}, {});
    const RunOptions options = runOptions(arguments);
    ProgressBar progress(common, "collide");
    if (arguments.explain) {
        reportExplanation(explainScene(scene, options, progress), common);
        return;
    }
    progress.expectFrames(options.firstFrame, options.lastFrame < 0 ? scene.frames : options.lastFrame,
                          scene.stepsPerFrame);
    const RunReport run = runScene(scene, options, progress);
    reportRun(run, common);
}

} // namespace

void addCollide(CLI::App& app, const CommonOptions& common)
{
    auto* verb = app.add_subcommand(
        "collide", "Run particles against colliders, from a scene file or in a quick form without one");
    auto arguments = std::make_shared<CollideArguments>();
    CollideArguments& a = *arguments;
    verb->add_option("SCENE", a.sceneFile, "Scene file, .toml");
    verb->add_flag("--explain", a.explain,
                   "Print the plan and what to expect, tried out on some particles, and run nothing");
    verb->add_option("--set", a.overrides, "Change a key of the scene, time.dt=0.002; may be repeated")
        ->take_all()
        ->expected(1)
        ->type_name("KEY=VALUE");
    verb->add_option("--frames", a.frames,
                     "Start from frame A (0: the particle file; else an earlier run's output) and go on to B")
        ->type_name("A-B");
    addLength(*verb, "--max-error", a.maxError,
              "Look level sets up in the cheapest way within this error, in place of [accuracy]");
    verb->add_flag("--strict", a.strict, "Exit 3 where particles are not finite or have a negative radius or mass");
    verb->add_option("--collider", a.colliders, "Level set to collide with, .vdb; may be repeated")
        ->expected(1)
        ->take_all()
        ->group("Quick form");
    verb->add_option("--particles", a.particles, "Particles: .vdb, .csv or .ply")->group("Quick form");
    verb->add_option("-o,--output", a.output, "Particles to write; with #### every step's, else the last")
        ->group("Quick form");
    verb->add_option("--dt", a.dt, "Seconds a step (default 0.004)")->group("Quick form")->type_name("S");
    verb->add_option("--steps", a.steps, "Steps to run")
        ->check(CLI::Range(1, 1000000000))
        ->group("Quick form")
        ->type_name("N");
    addVector(*verb, "--gravity", a.gravity, "Acceleration (default 0,-9.81,0)")->group("Quick form");
    verb->add_option("--restitution", a.restitution, "0 to 1 (default 0.3)")->group("Quick form")->type_name("E");
    verb->add_option("--friction", a.friction, "Coulomb's mu (default 0.5)")->group("Quick form")->type_name("MU");
    addLength(*verb, "--radius", a.radius, "Radius of particles whose file has none (default 0)")->group("Quick form");
    verb->footer("Examples:\n  vdbounce collide scene.toml --set collider.bunny.friction=0.2\n"
                 "  vdbounce collide --collider bunny.vdb --particles cloud.vdb -o after.vdb --steps 200");
    verb->callback([arguments, &common] { runWith(common, [&] { runCollide(*arguments, common); }); });
}

} // namespace vdbounce::tool
