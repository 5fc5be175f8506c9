// SPDX-License-Identifier: Apache-2.0
#include "mesh2ls_conversion.h"

#include "progress_bar.h"
#include "stopwatch.h"
#include "thin_report.h"
#include "voxel_text.h"

#include "vdbounce/build/velocity_grid.h"
#include "vdbounce/build/verify_level_set.h"
#include "vdbounce/io/grid_file.h"

#include <algorithm>
#include <cstdio>

namespace vdbounce::tool {
namespace {

Json choicesJson(const std::vector<SignChoice>& choices)
{
    Json json = Json::array();
    for (const SignChoice& choice : choices) {
        json.push_back({{"method", signMethodName(choice.method)},
                        {"components", choice.components},
                        {"triangles", choice.triangles},
                        {"reason", choice.reason}});
    }
    return json;
}

// Of a time that is a guess: no finer than tenths.
std::string waitText(double seconds)
{
    char text[32];
    std::snprintf(text, sizeof(text), seconds < 10.0 ? "%.1f s" : "%.0f s", std::max(seconds, 0.1));
    return text;
}

// A line each; nothing where there was nothing to choose.
std::string choicesText(const std::vector<SignChoice>& choices)
{
    if (choices.size() == 1 && choices.front().plain) return "";
    std::string text;
    for (const SignChoice& choice : choices) {
        text += std::string("\nsign by ") + signMethodName(choice.method) + ": " +
                counted(choice.components, "component") + ", " + counted(choice.triangles, "triangle") + ": " +
                choice.reason;
    }
    return text;
}

ConversionReport describe(const MeshFrame& frame, const MeshToLevelSetResult& result, double seconds)
{
    const LevelSetSummary summary = summarize(result.grid);
    ConversionReport report;
    report.json = {{"output", frame.output},
                   {"triangles", frame.mesh.triangles.size()},
                   {"voxel_size", voxelJson(summary.voxelSize)},
                   {"active_voxels", summary.activeVoxels},
                   {"sign", signMethodName(result.sign)},
                   {"choices", choicesJson(result.choices)},
                   {"doubtful_voxels", result.doubtfulVoxels}};
    report.text = frame.output + ": " + counted(frame.mesh.triangles.size(), "triangle") + ", voxel " +
                  voxelText(summary.voxelSize) + ", " + grouped(summary.activeVoxels) + " active voxels, sign by " +
                  signMethodName(result.sign) + ", " + rounded(seconds) + " s" + choicesText(result.choices);
    return report;
}

} // namespace

MeshConversion::MeshConversion(const Mesh2lsArguments& arguments, const CommonOptions& common,
                               const LinearTransform& transform)
    : arguments_(arguments), common_(common), options_(optionsFor(arguments, transform))
{
}

ConversionEstimate MeshConversion::expect(const MeshFrame& frame) const
{
    const ConversionEstimate expected = expectConversion(frame.mesh, options_);
    announce(common_, frame.input + ": " + counted(frame.mesh.triangles.size(), "triangle") + "; expecting about " +
                          about(expected.activeVoxels) + " voxels, " + bytesText(expected.bytes) + " and " +
                          waitText(expected.cpuSeconds / threadsUsed(common_)));
    return expected;
}

void MeshConversion::verify(const MeshFrame& frame, const MeshToLevelSetResult& result,
                            ConversionReport& conversion) const
{
    VerifyOptions options;
    options.sign = options_.sign;
    options.thickness = options_.thicknessVx * options_.transform->voxelSize().maxCoeff();
    options.half = arguments_.half;
    const VerifyReport found = verifyLevelSet(result.grid, frame.mesh, options);
    conversion.json["verify"] = {{"samples", found.samples},
                                 {"max_error_vx", found.maxErrorVx},
                                 {"rms_error_vx", found.rmsErrorVx},
                                 {"sign_errors", found.signErrors}};
    conversion.text += "\nverified " + grouped(found.samples) + " voxels: largest error " + rounded(found.maxErrorVx) +
                       " voxels, rms " + rounded(found.rmsErrorVx) + ", " + grouped(found.signErrors) + " signs wrong";
    const double allowed = toleranceVx(arguments_, options_);
    if (found.maxErrorVx > allowed || found.signErrors > 0) {
        throw ToleranceError(frame.output,
                             "largest error " + rounded(found.maxErrorVx) + "vx and " + grouped(found.signErrors) +
                                 " wrong signs, beyond --tolerance " + rounded(allowed) + "vx",
                             "nothing was written; allow more or use another --sign");
    }
}

void MeshConversion::write(const MeshFrame& frame, const MeshToLevelSetResult& result) const
{
    GridWriteOptions options;
    options.half = arguments_.half;
    if (arguments_.closest) options.beside.push_back(result.closest);
    options.beside.push_back(result.confidence);
    if (arguments_.velocity) options.beside.push_back(velocityGrid(result.closest, frame.mesh, frame.velocities));
    writeLevelSet(result.grid, frame.output, options);
}

ConversionReport MeshConversion::convert(const MeshFrame& frame)
{
    ProgressBar progress(common_, "mesh2ls");
    const ConversionEstimate expected = expect(frame);
    Stopwatch watch;
    // What a mesh leaves behind is for the next one of a sequence.
    const MeshToLevelSetResult result = arguments_.isSequence()
                                            ? meshToLevelSet(frame.mesh, options_, memory_, progress)
                                            : meshToLevelSet(frame.mesh, options_, progress);
    const ThinFeatures thin = thinFeatures(result.grid);
    const double buildSeconds = watch.lap();
    for (const std::string& warning : result.warnings) warn(common_, frame.input + ": " + warning);
    ConversionReport conversion = describe(frame, result, frame.readSeconds + buildSeconds);
    conversion.json["warnings"] = result.warnings;
    conversion.json["thin_walls"] = thinJson(thin.walls);
    conversion.json["thin_gaps"] = thinJson(thin.gaps);
    conversion.json["expected"] = {
        {"active_voxels", expected.activeVoxels}, {"bytes", expected.bytes}, {"cpu_seconds", expected.cpuSeconds}};
    if (arguments_.verified()) verify(frame, result, conversion);
    for (const std::string& warning : thinWarnings(thin, options_.transform->smallestVoxelSize()))
        warn(common_, frame.input + ": " + warning);
    watch.lap();
    write(frame, result);
    conversion.json["seconds"] = {{"read", frame.readSeconds}, {"build", buildSeconds}, {"write", watch.lap()}};
    return conversion;
}

} // namespace vdbounce::tool
