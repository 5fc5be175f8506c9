// SPDX-License-Identifier: Apache-2.0
#include "make_arguments.h"
#include "make_output.h"
#include "progress_bar.h"
#include "signals.h"
#include "stopwatch.h"

#include "vdbounce/implicit/sample_field.h"
#include "vdbounce/implicit/shapes.h"

#include <functional>
#include <memory>

namespace vdbounce::tool {
namespace {

// What one shape of `make` was asked for. The options of the shape's own write into `shape`.
template <class Formula> struct ShapeArguments {
    Formula shape;
    MakeArguments make;
    std::optional<Vec3d> min; // of a plane, which has no end
    std::optional<Vec3d> max;
};

template <class Formula> void run(const ShapeArguments<Formula>& arguments, const CommonOptions& common)
{
    requireSound(arguments.make);
    endAtOnceWhenInterrupted();
    const ShapeFormula formula = arguments.shape;
    const auto field = makeField(formula);
    SampleFieldOptions options;
    options.voxelSize = arguments.make.voxel;
    options.exteriorVx = arguments.make.exteriorVx();
    options.interiorVx = arguments.make.interiorVx();
    options.gridName = arguments.make.name;
    options.maxMemory = arguments.make.maxMemory;
    if (arguments.min && arguments.max) options.within = Box{*arguments.min, *arguments.max};
    const std::string name = nameOf(formula);
    Stopwatch building;
    const LevelSetGrid grid = [&] {
        ProgressBar progress(common, "make " + name);
        return sampleField(*field, options, progress);
    }();
    writeMade(grid, name, arguments.make, building.lap(), common);
}

// Adds the verb of one shape; `addOwn` adds the options of its own.
template <class Formula>
void addShape(CLI::App& make, const CommonOptions& common, const char* name, const char* help, const char* example,
              const std::function<void(CLI::App&, ShapeArguments<Formula>&)>& addOwn)
{
    auto* verb = make.add_subcommand(name, help);
    auto arguments = std::make_shared<ShapeArguments<Formula>>();
    addOwn(*verb, *arguments);
    addMakeOptions(*verb, arguments->make);
    verb->footer(std::string("Example:\n  vdbounce make ") + name + " " + example + " -o " + name + ".vdb");
    verb->callback([arguments, &common] { runWith(common, [&] { run(*arguments, common); }); });
}

void addRadius(CLI::App& verb, const char* name, double& radius, const char* help)
{
    verb.add_option(name, radius, help)->required()->type_name("R");
}

void addRotation(CLI::App& verb, Eigen::Quaterniond& rotate)
{
    verb.add_option_function<std::vector<double>>(
            "--rotate",
            [&rotate](const std::vector<double>& q) { rotate = Eigen::Quaterniond(q[0], q[1], q[2], q[3]); },
            "Rotation about the centre, a quaternion")
        ->delimiter(',')
        ->expected(4)
        ->type_name("W,X,Y,Z");
}

template <class Formula> void addEnds(CLI::App& verb, ShapeArguments<Formula>& a, const char* from, const char* to)
{
    addVector(verb, "--from", a.shape.from, from)->required();
    addVector(verb, "--to", a.shape.to, to)->required();
    addRadius(verb, "--radius", a.shape.radius, "Radius, world units");
}

void addRoundShapes(CLI::App& make, const CommonOptions& common)
{
    addShape<SphereShape>(make, common, "sphere", "A ball", "--center 0,1,0 --radius 0.5 --voxel 0.01",
                          [](CLI::App& verb, auto& a) {
                              addVector(verb, "--center", a.shape.centre, "Its centre")->required();
                              addRadius(verb, "--radius", a.shape.radius, "Its radius, world units");
                          });
    addShape<EllipsoidShape>(make, common, "ellipsoid", "An ellipsoid along the axes, with true distance",
                             "--center 0,0,0 --radii 1,0.5,0.2 --voxel 0.01", [](CLI::App& verb, auto& a) {
                                 addVector(verb, "--center", a.shape.centre, "Its centre")->required();
                                 addVector(verb, "--radii", a.shape.radii, "Its radii along x, y, z")->required();
                             });
    addShape<CapsuleShape>(make, common, "capsule", "All that is within a radius of a line",
                           "--from 0,0,0 --to 0,1,0 --radius 0.2 --voxel 0.01",
                           [](CLI::App& verb, auto& a) { addEnds(verb, a, "One end of the line", "The other end"); });
    addShape<TorusShape>(make, common, "torus", "A ring",
                         "--center 0,0,0 --axis 0,1,0 --major 1 --minor 0.3 --voxel 0.02", [](CLI::App& verb, auto& a) {
                             addVector(verb, "--center", a.shape.centre, "Its centre")->required();
                             addVector(verb, "--axis", a.shape.axis, "What it goes around (default 0,1,0)");
                             addRadius(verb, "--major", a.shape.major, "From the centre to the middle of the tube");
                             addRadius(verb, "--minor", a.shape.minor, "Radius of the tube");
                         });
}

void addFlatShapes(CLI::App& make, const CommonOptions& common)
{
    addShape<BoxShape>(make, common, "box", "A box", "--center 0,0,0 --half 1,0.5,1 --voxel 0.02",
                       [](CLI::App& verb, auto& a) {
                           addVector(verb, "--center", a.shape.centre, "Its centre")->required();
                           addVector(verb, "--half", a.shape.half, "Half its sides")->required();
                           addRotation(verb, a.shape.rotate);
                       });
    addShape<CylinderShape>(
        make, common, "cylinder", "A cylinder with flat ends", "--from 0,0,0 --to 0,1,0 --radius 0.3 --voxel 0.01",
        [](CLI::App& verb, auto& a) { addEnds(verb, a, "Middle of one end", "Middle of the other"); });
    addShape<ConeShape>(
        make, common, "cone", "A cone, or a cut one", "--from 0,0,0 --to 0,1,0 --radius 0.3 --voxel 0.01",
        [](CLI::App& verb, auto& a) {
            addEnds(verb, a, "Middle of the base", "The tip, or the middle of the top");
            verb.add_option("--top-radius", a.shape.topRadius, "Radius of the top (default 0: a tip)")->type_name("R");
        });
    addShape<PlaneShape>(make, common, "plane", "The half space behind a plane, within a box",
                         "--point 0,0,0 --normal 0,1,0 --min -1,-0.2,-1 --max 1,0.2,1 --voxel 0.02",
                         [](CLI::App& verb, auto& a) {
                             addVector(verb, "--point", a.shape.point, "A point of the plane")->required();
                             addVector(verb, "--normal", a.shape.normal, "Points out of the solid")->required();
                             addVector(verb, "--min", a.min, "Lower corner of the box to fill")->required();
                             addVector(verb, "--max", a.max, "Upper corner")->required();
                         });
}

} // namespace

void addMake(CLI::App& app, const CommonOptions& common)
{
    auto* verb = app.add_subcommand("make", "Make a level set of a shape that has a formula");
    verb->require_subcommand(1);
    verb->footer("Example:\n  vdbounce make sphere --center 0,1,0 --radius 0.5 --voxel 0.01 -o sphere.vdb");
    addRoundShapes(*verb, common);
    addFlatShapes(*verb, common);
    addMakeHeightfield(*verb, common);
}

} // namespace vdbounce::tool
