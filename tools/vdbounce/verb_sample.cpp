// SPDX-License-Identifier: Apache-2.0
#include "option_values.h"
#include "report.h"
#include "signals.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/field/distance_field.h"
#include "vdbounce/io/grid_file.h"
#include "vdbounce/io/number_text.h"
#include "vdbounce/io/particle_file.h"
#include "vdbounce/io/safe_file.h"

#include <map>
#include <memory>

namespace vdbounce::tool {
namespace {

constexpr std::size_t kRowsPerBlock = 8192;

struct SampleArguments {
    std::string field;
    std::string points;
    std::string output;
    std::string grid;
    FieldOptions options;
};

void appendRow(std::string& text, const DistanceField& field, const Vec3d& point)
{
    const FieldSample sample = field.sample(point);
    const Interval bounds = field.bounds(point);
    const double values[] = {point.x(),           point.y(),           point.z(),    sample.phi,  sample.gradient.x(),
                             sample.gradient.y(), sample.gradient.z(), bounds.lower, bounds.upper};
    for (double value : values) {
        appendNumber(text, value);
        text += ',';
    }
    text.back() = '\n';
}

void runSample(const SampleArguments& arguments, const CommonOptions& common)
{
    requireOutput(arguments.output, {"csv"}, {arguments.field, arguments.points});
    const DistanceField field(readLevelSet(arguments.field, arguments.grid), arguments.options);
    const Particles points = readParticles(arguments.points);
    std::vector<std::string> blocks(blockCount(points.size(), kRowsPerBlock));
    forEachBlock(points.size(), kRowsPerBlock, [&](std::size_t block, IndexRange range) {
        for (std::size_t i = range.begin; i < range.end; ++i) appendRow(blocks[block], field, points.position[i]);
        throwIfInterrupted();
    });
    SafeFile file(arguments.output);
    file.write(std::string("x,y,z,phi,gx,gy,gz,lo,hi\n"));
    for (const std::string& block : blocks) file.write(block);
    file.commit();
    const double errorVx = field.storageError() / field.voxelSize();
    std::string text = arguments.output + ": " + grouped(points.size()) + " points";
    if (errorVx > 0.0) text += ", phi off by at most " + rounded(errorVx) + " voxels for the storage";
    report(common, {{"output", arguments.output}, {"points", points.size()}, {"storage_error_vx", errorVx}}, text);
}

} // namespace

void addSample(CLI::App& app, const CommonOptions& common)
{
    auto* verb = app.add_subcommand("sample", "Look a field up at points: distance, gradient, bounds");
    auto arguments = std::make_shared<SampleArguments>();
    verb->add_option("FIELD", arguments->field, "Level set, .vdb")->required();
    verb->add_option("--at", arguments->points, "Points: .csv, .ply or .vdb")->required();
    verb->add_option("-o,--output", arguments->output, "Table to write, .csv: x,y,z,phi,gx,gy,gz,lo,hi in input order")
        ->required();
    verb->add_option("--grid", arguments->grid, "Name of the grid, where the file holds several (default the first)");
    addChoice(*verb, "--lookup", arguments->options.lookup, named<Lookup>(kLookupNames),
              "How phi is taken from the voxels: nearest, trilinear (default), cubic");
    addChoice(*verb, "--normal", arguments->options.normal, named<Normal>(kNormalNames),
              "Gradient: central differences, interpolated (default), or the analytic one of the interpolation");
    addChoice(*verb, "--storage", arguments->options.storage, named<Storage>(kStorageNames),
              "Keep values as float (default), half or fixed8");
    verb->footer("Example:\n  vdbounce sample bunny.vdb --at points.csv -o phi.csv");
    verb->callback([arguments, &common] { runWith(common, [&] { runSample(*arguments, common); }); });
}

} // namespace vdbounce::tool
