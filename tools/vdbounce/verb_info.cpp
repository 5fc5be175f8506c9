// SPDX-License-Identifier: Apache-2.0
#include "description.h"

#include "vdbounce/io/file_bytes.h"
#include "vdbounce/io/grid_file.h"
#include "vdbounce/io/mesh_file.h"

#include <memory>

namespace vdbounce::tool {
namespace {

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
    for (const GridEntry& grid : listGrids(path)) descriptions.push_back(describeGrid(path, grid));
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
        if (entry["holds"].empty()) text += (text.empty() ? "" : "\n") + path + ": holds nothing";
        json["files"].push_back(entry);
    }
    report(common, json, text);
}

} // namespace

void addInfo(CLI::App& app, const CommonOptions& common)
{
    auto* verb = app.add_subcommand("info", "Tell what files hold, and whether they are fit to collide with");
    auto files = std::make_shared<std::vector<std::string>>();
    verb->add_option("FILES", *files, "Level sets and other grids, particles or meshes")->required();
    verb->footer("Example:\n  vdbounce info bunny.vdb");
    verb->callback([files, &common] { runWith(common, [&] { runInfo(*files, common); }); });
}

} // namespace vdbounce::tool
