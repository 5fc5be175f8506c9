// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/scene/accuracy_cache.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/content_hash.h"
#include "vdbounce/io/grid_file.h"
#include "vdbounce/io/number_text.h"
#include "vdbounce/io/safe_file.h"

#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <optional>

namespace vdbounce {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr double kMostLeaves = 1e12; // more than fit into any memory
constexpr int kVersion = 2;          // of how it is measured, and of the file's keys

std::string cachePath(const std::string& path) { return path + ".accuracy"; }

std::string toText(const LookupErrors& errors, const std::string& path, const std::string& hash)
{
    std::string text = "# What lookups in " + std::filesystem::path(path).filename().string() +
                       " are off by, in world units. Measured again when the file changes; may be removed.\n";
    text += "version = " + std::to_string(kVersion) + "\n";
    text += "content = \"" + hash + "\"\n";
    text += "voxel = " + numberText(errors.voxel) + "\n";
    text += "leaves = " + std::to_string(errors.leaves) + "\n";
    text += "resolution = " + numberText(errors.resolution.error) + "\n";
    text += "order = " + numberText(errors.resolution.order) + "\n";
    for (const ChoiceError& error : errors.choices) {
        text += "\n[[choice]]\nlookup = \"" + std::string(nameOf(error.choice.lookup)) + "\"\n";
        text += "normal = \"" + std::string(nameOf(error.choice.normal)) + "\"\n";
        text += "storage = \"" + std::string(nameOf(error.choice.storage)) + "\"\n";
        text += "phi_error = " + numberText(error.phi) + "\n";
        text += "normal_error = " + numberText(error.normal) + "\n";
    }
    return text;
}

// Nothing unless all of it is there.
std::optional<LookupErrors> fromTable(const toml::table& table)
{
    bool complete = true;
    const auto number = [&](toml::node_view<const toml::node> node) {
        const std::optional<double> value = node.value<double>();
        complete = complete && value && *value >= 0.0; // infinite where the voxels do not tell
        return value.value_or(0.0);
    };
    const auto view = [&](const toml::table& at, const char* key) { return at[key]; };
    LookupErrors errors;
    errors.voxel = number(view(table, "voxel"));
    errors.leaves = std::uint64_t(std::min(number(view(table, "leaves")), kMostLeaves));
    errors.resolution = {number(view(table, "resolution")), number(view(table, "order"))};
    const toml::array* choices = table["choice"].as_array();
    if (choices == nullptr || choices->size() != choicesByCost().size() || !choices->is_array_of_tables())
        return std::nullopt;
    for (std::size_t i = 0; i < choices->size(); ++i) {
        const toml::table& one = *choices->get(i)->as_table();
        const FieldOptions& choice = choicesByCost()[i];
        complete = complete && one["lookup"] == nameOf(choice.lookup) && one["normal"] == nameOf(choice.normal) &&
                   one["storage"] == nameOf(choice.storage);
        errors.choices.push_back({choice, number(view(one, "phi_error")), number(view(one, "normal_error"))});
    }
    return complete ? std::optional(errors) : std::nullopt;
}

std::optional<LookupErrors> readCache(const std::string& path, const std::string& hash)
{
    if (!std::filesystem::is_regular_file(cachePath(path))) return std::nullopt;
    try {
        const toml::table table = toml::parse_file(cachePath(path));
        if (table["version"] != kVersion || table["content"] != hash) return std::nullopt;
        return fromTable(table);
    } catch (const toml::parse_error&) {
        return std::nullopt; // somebody else's, or damaged
    }
}

} // namespace

LookupErrors lookupErrorsOf(const std::string& path)
{
    const std::string hash = contentHash(path);
    if (const auto cached = readCache(path, hash)) return *cached;
    const LookupErrors errors = measureLookupErrors(readLevelSet(path), kSeed);
    try {
        writeTextFile(cachePath(path), toText(errors, path, hash));
    } catch (const RunError&) {
        // A folder that is read-only is no reason not to run.
    }
    return errors;
}

} // namespace vdbounce
