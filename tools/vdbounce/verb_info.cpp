// SPDX-License-Identifier: Apache-2.0
#include "report.h"
#include "thin_report.h"

#include "vdbounce/base/error.h"
#include "vdbounce/field/distance_field.h"
#include "vdbounce/io/file_bytes.h"
#include "vdbounce/io/grid_file.h"
#include "vdbounce/io/mesh_file.h"
#include "vdbounce/io/particle_file.h"

#include <cmath>
#include <memory>

namespace vdbounce::tool {
namespace {

struct Description {
    Json json;
    std::string text;
};

// Half a band of two voxels is the least that trilinear lookup with central differences at the surface needs.
constexpr double kThinnestBandVx = 2.0;
// How much steeper than a distance a field may be before "distance" is the wrong word for it.
constexpr double kSteepest = 1.75; // the square root of three, and rounding

std::string verdictOn(const LevelSetSummary& summary, const DistanceField& field)
{
    if (summary.activeVoxels == 0) return "not fit to collide with: it is empty";
    if (summary.halfWidthVx < kThinnestBandVx)
        return "not fit to collide with: its band is thinner than 2 voxels; make it with --band 3vx";
    if (field.clipped()) return "fit to collide with inside its box; its surface is cut off there";
    if (field.lipschitz() > kSteepest)
        return "usable, but its values change faster than distances do (" + rounded(field.lipschitz()) +
               " a unit); make it from its mesh again";
    return "fit to collide with";
}

Description describeLevelSet(const std::string& path, const std::string& gridName)
{
    const LevelSetGrid grid = readLevelSet(path, gridName);
    const LevelSetSummary s = summarize(grid);
    const DistanceField field(grid);
    const std::string verdict = verdictOn(s, field);
    const ThinFeatures thin = thinFeatures(grid);
    Json json = {{"kind", "level set"},
                 {"name", s.name},
                 {"type", s.valueType},
                 {"voxel_size", toJson(s.voxelSize)},
                 {"background", s.background},
                 {"half_width_vx", s.halfWidthVx},
                 {"active_voxels", s.activeVoxels},
                 {"memory_bytes", s.memoryBytes},
                 {"box_min", toJson(s.worldBox.min)},
                 {"box_max", toJson(s.worldBox.max)},
                 {"clipped", field.clipped()},
                 {"steepest", field.lipschitz()},
                 {"thin_walls", thinJson(thin.walls)},
                 {"thin_gaps", thinJson(thin.gaps)},
                 {"verdict", verdict}};
    std::string text = "level set '" + s.name + "' (" + s.valueType + "): voxel " + vectorText(s.voxelSize) +
                       ", half width " + rounded(s.halfWidthVx) + " voxels, " + grouped(s.activeVoxels) +
                       " active voxels, box " + vectorText(s.worldBox.min) + " to " + vectorText(s.worldBox.max) +
                       "; " + verdict;
    for (const std::string& warning : thinWarnings(thin, s.voxelSize.minCoeff())) text += "; warning: " + warning;
    return {json, text};
}

std::string attributeNames(const Particles& particles)
{
    std::string names = "position";
    if (!particles.velocity.empty()) names += ", velocity";
    if (!particles.radius.empty()) names += ", radius";
    if (!particles.mass.empty()) names += ", mass";
    return names + ", id";
}

Description describeParticles(const std::string& path)
{
    const Particles particles = readParticles(path);
    const Box box = boundingBox(particles);
    std::uint64_t bad = 0;
    double fastest = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const double speed = particles.velocity.empty() ? 0.0 : particles.velocity[i].norm();
        if (particles.position[i].allFinite() && std::isfinite(speed)) {
            fastest = std::max(fastest, speed);
        } else {
            ++bad;
        }
    }
    const Json json = {
        {"kind", "particles"},        {"particles", particles.size()}, {"attributes", attributeNames(particles)},
        {"box_min", toJson(box.min)}, {"box_max", toJson(box.max)},    {"fastest", fastest},
        {"not_finite", bad}};
    std::string text = grouped(particles.size()) + " particles with " + attributeNames(particles);
    if (!box.empty())
        text += ", box " + vectorText(box.min) + " to " + vectorText(box.max) + ", fastest " + rounded(fastest);
    if (bad > 0) text += ", " + grouped(bad) + " not finite";
    return {json, text};
}

Description describeMesh(const std::string& path)
{
    const TriangleMesh mesh = readMesh(path);
    const EdgeReport edges = inspectEdges(mesh);
    const Box box = boundingBox(mesh);
    const bool sound = edges.closedAndOriented();
    const Json json = {{"kind", "mesh"},
                       {"points", mesh.points.size()},
                       {"triangles", mesh.triangles.size()},
                       {"open_edges", edges.open},
                       {"non_manifold_edges", edges.nonManifold},
                       {"inconsistent_edges", edges.inconsistent},
                       {"closed", sound},
                       {"box_min", toJson(box.min)},
                       {"box_max", toJson(box.max)}};
    std::string text = "mesh: " + grouped(mesh.points.size()) + " points, " + grouped(mesh.triangles.size()) +
                       " triangles, box " + vectorText(box.min) + " to " + vectorText(box.max);
    text += sound ? "; closed and oriented, fit for mesh2ls"
                  : "; " + grouped(edges.open) + " open, " + grouped(edges.nonManifold) + " non-manifold and " +
                        grouped(edges.inconsistent) + " inconsistent edges: mesh2ls will warn";
    return {json, text};
}

// PLY files hold meshes or points; those with faces are meshes.
bool isMesh(const std::string& path)
{
    if (fileEnding(path) != "ply") return isMeshFile(path);
    const FileBytes bytes(path);
    return bytes.view().substr(0, bytes.view().find("end_header")).find("element face") != std::string_view::npos;
}

std::vector<Description> describe(const std::string& path)
{
    requireReadableFile(path);
    if (isMesh(path)) return {describeMesh(path)};
    if (fileEnding(path) != "vdb") return {describeParticles(path)};
    std::vector<Description> descriptions;
    for (const GridEntry& grid : listGrids(path)) {
        if (grid.isPoints) {
            descriptions.push_back(describeParticles(path));
        } else if (grid.gridClass == "level set") {
            descriptions.push_back(describeLevelSet(path, grid.name));
        } else {
            descriptions.push_back({{{"kind", "other"},
                                     {"name", grid.name},
                                     {"type", grid.valueType},
                                     {"class", grid.gridClass},
                                     {"verdict", "not fit to collide with: it is no level set"}},
                                    "grid '" + grid.name + "' (" + grid.valueType + ", " + grid.gridClass +
                                        "); not fit to collide with: it is no level set"});
        }
    }
    return descriptions;
}

void runInfo(const std::vector<std::string>& files, const CommonOptions& common)
{
    Json json = {{"files", Json::array()}};
    std::string text;
    for (const std::string& path : files) {
        Json entry = {{"file", path}, {"holds", Json::array()}};
        for (const Description& description : describe(path)) {
            entry["holds"].push_back(description.json);
            text += (text.empty() ? "" : "\n") + path + ": " + description.text;
        }
        json["files"].push_back(entry);
    }
    report(common, json, text);
}

} // namespace

void addInfo(CLI::App& app, const CommonOptions& common)
{
    auto* verb = app.add_subcommand("info", "Tell what files hold, and whether they are fit to collide with");
    auto files = std::make_shared<std::vector<std::string>>();
    verb->add_option("FILES", *files, "Level sets, particles or meshes")->required();
    verb->footer("Example:\n  vdbounce info bunny.vdb");
    verb->callback([files, &common] { runWith(common, [&] { runInfo(*files, common); }); });
}

} // namespace vdbounce::tool
