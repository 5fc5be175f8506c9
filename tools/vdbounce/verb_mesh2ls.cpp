// SPDX-License-Identifier: Apache-2.0
#include "mesh2ls_arguments.h"
#include "mesh2ls_conversion.h"
#include "signals.h"
#include "stopwatch.h"

#include "vdbounce/base/error.h"
#include "vdbounce/build/velocity_grid.h"
#include "vdbounce/io/frame_files.h"
#include "vdbounce/io/mesh_file.h"
#include "vdbounce/scene/scene.h"

#include <map>
#include <memory>

namespace vdbounce::tool {
namespace {

struct TimedMesh {
    TriangleMesh mesh;
    double readSeconds = 0.0;
};

TimedMesh readTimed(const std::string& path)
{
    Stopwatch watch;
    TimedMesh timed;
    timed.mesh = readMesh(path);
    timed.readSeconds = watch.lap();
    return timed;
}

// The meshes of a sequence, each read once, when it is first asked for.
class FrameMeshes {
public:
    explicit FrameMeshes(const std::vector<FrameFile>& files) : files_(files) {}

    const TimedMesh& at(std::size_t i)
    {
        const auto found = held_.find(i);
        return found != held_.end() ? found->second : held_.emplace(i, readTimed(files_[i].path)).first->second;
    }

    // Of frame i's points, from the frames beside it.
    std::vector<Vec3d> velocities(std::size_t i, double secondsPerFrame)
    {
        const std::size_t before = i > 0 ? i - 1 : i;
        const std::size_t after = i + 1 < files_.size() ? i + 1 : i;
        requireSame(before, i);
        requireSame(i, after);
        return pointVelocities(at(before).mesh, at(after).mesh, double(after - before) * secondsPerFrame);
    }

    // Lets go of all before frame i.
    void forgetBefore(std::size_t i) { held_.erase(held_.begin(), held_.lower_bound(i)); }

private:
    void requireSame(std::size_t one, std::size_t next)
    {
        const TriangleMesh& a = at(one).mesh;
        const TriangleMesh& b = at(next).mesh;
        if (a.triangles == b.triangles && a.points.size() == b.points.size()) return;
        throw InputError(files_[next].path, "has other triangles than frame " + std::to_string(files_[one].frame),
                         "--velocity needs the same triangles in all frames; leave it out");
    }

    const std::vector<FrameFile>& files_;
    std::map<std::size_t, TimedMesh> held_;
};

void convertSequence(const Mesh2lsArguments& arguments, const CommonOptions& common)
{
    const std::vector<FrameFile> files = findFrames(arguments.input);
    if (arguments.velocity && files.size() < 2)
        throw InputError(arguments.input, "is one frame, and velocities need two", "leave --velocity out");
    for (const FrameFile& file : files)
        requireOutput(framePath(arguments.output, file.frame), {"vdb"}, {arguments.like});
    FrameMeshes meshes(files);
    MeshConversion conversion(arguments, common, transformFor(arguments, meshes.at(0).mesh, files[0].path));
    Json frames = Json::array();
    std::map<std::string, double> seconds;
    std::string text;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const TimedMesh& timed = meshes.at(i);
        MeshFrame frame{files[i].path, framePath(arguments.output, files[i].frame), timed.mesh, timed.readSeconds, {}};
        if (arguments.velocity) frame.velocities = meshes.velocities(i, arguments.secondsPerFrame());
        ConversionReport report = conversion.convert(frame);
        for (const char* part : {"read", "build", "write"}) seconds[part] += report.json["seconds"][part].get<double>();
        text += (i > 0 ? "\n" : "") + report.text;
        report.json["frame"] = files[i].frame;
        frames.push_back(std::move(report.json));
        meshes.forgetBefore(i);
    }
    Json json = {{"output", arguments.output}};
    for (const char* key : {"triangles", "voxel_size", "active_voxels", "sign"}) json[key] = frames.back()[key];
    json["warnings"] = Json::array();
    for (const Json& frame : frames) {
        for (const Json& warning : frame["warnings"]) json["warnings"].push_back(warning);
    }
    json["seconds"] = {{"read", seconds["read"]}, {"build", seconds["build"]}, {"write", seconds["write"]}};
    json["frames"] = std::move(frames);
    report(common, json, text);
}

void convertOne(const Mesh2lsArguments& arguments, const CommonOptions& common)
{
    const TimedMesh timed = readTimed(arguments.input);
    MeshConversion conversion(arguments, common, transformFor(arguments, timed.mesh, arguments.input));
    const ConversionReport done =
        conversion.convert({arguments.input, arguments.output, timed.mesh, timed.readSeconds, {}});
    report(common, done.json, done.text);
}

void runMesh2ls(const Mesh2lsArguments& arguments, const CommonOptions& common)
{
    requireSound(arguments);
    // All that is written is written at the end, or whole frames.
    endAtOnceWhenInterrupted();
    arguments.isSequence() ? convertSequence(arguments, common) : convertOne(arguments, common);
}

} // namespace

void addMesh2ls(CLI::App& app, const CommonOptions& common)
{
    auto* verb = app.add_subcommand("mesh2ls", "Turn a triangle mesh into a level set");
    auto arguments = std::make_shared<Mesh2lsArguments>();
    addMesh2lsOptions(*verb, *arguments);
    verb->callback([arguments, &common] { runWith(common, [&] { runMesh2ls(*arguments, common); }); });
}

} // namespace vdbounce::tool
