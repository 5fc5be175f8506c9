// SPDX-License-Identifier: Apache-2.0
#include "describe_level_set.h"
#include "description.h"
#include "transform_words.h"

#include "vdbounce/base/error.h"
#include "vdbounce/field/grid_transform.h"
#include "vdbounce/field/value_range.h"
#include "vdbounce/io/scalar_grid.h"

namespace vdbounce::tool {
namespace {

bool holdsNumbers(const GridEntry& entry)
{
    return entry.valueType == "float" || entry.valueType == "double" || entry.valueType == "half";
}

// Of a grid that cannot be a level set, with what was found out about it.
Description describeOther(const GridEntry& entry, const std::string& why, const std::string& remedy, Json found = {},
                          const std::string& lines = "")
{
    Json json = {{"kind", entry.gridClass == "fog volume" ? "fog volume" : "other"},
                 {"name", entry.name},
                 {"type", entry.valueType},
                 {"class", entry.gridClass}};
    if (found.is_object()) json.update(found);
    Verdict verdict;
    verdict.faults.push_back({Fitness::Unfit, why, remedy});
    addVerdict(verdict, json);
    return {json, (entry.gridClass == "fog volume" ? "fog volume '" : "grid '") + entry.name + "' (" + entry.valueType +
                      ", class '" + entry.gridClass + "'): " + verdict.sentence() + lines};
}

// Where its values are half of what they are at most lies the middle of a fog's edge.
std::string levelSetCommand(const std::string& path, const GridEntry& entry, const ValueRange& range)
{
    if (entry.gridClass == "level set") return redistanceCommand(path);
    if (entry.gridClass == "fog volume")
        return redistanceCommand(path, "--iso " + rounded(range.highest > 0.0f ? 0.5 * double(range.highest) : 0.5));
    return "where its surface is at a value V, " + redistanceCommand(path, "--iso V") + " makes one";
}

// What is wrong, out of "PLACE: WHAT; WHAT TO DO".
std::string problemOf(const Error& error, const std::string& place)
{
    const std::string text = std::string(error.what()).substr(place.size() + 2);
    return text.substr(0, text.rfind("; "));
}

Description describeNumbers(const std::string& path, const GridEntry& entry, const ScalarGrid& grid,
                            const std::string& why)
{
    const ValueRange range = valueRange(grid);
    const Json found = {{"transform", transformJson(transformOf(grid))},
                        {"lowest", range.lowest},
                        {"highest", range.highest},
                        {"not_finite", range.notFinite}};
    return describeOther(entry, why, levelSetCommand(path, entry, range), found,
                         labelled("voxels", transformWords(transformOf(grid))) +
                             labelled("values", rounded(range.lowest) + " to " + rounded(range.highest)));
}

} // namespace

Description describeGrid(const std::string& path, const GridEntry& entry)
{
    if (entry.isPoints) return describeParticles(path);
    if (!holdsNumbers(entry)) return describeOther(entry, "it is no level set", "name a grid of signed distances");
    if (!entry.linear)
        return describeOther(entry, "its voxels do not lie on straight lines",
                             "resample it onto a grid whose voxels do");
    const ScalarGrid numbers = readScalarGrid(path, entry.name);
    const std::string place = "grid '" + entry.name + "'";
    LevelSetGrid grid;
    try {
        grid = toLevelSetGrid(numbers, place);
    } catch (const InputError& error) {
        const std::string kind = entry.gridClass == "unknown" ? "is no level set, and " : "";
        return describeNumbers(path, entry, numbers, "it " + kind + problemOf(error, place));
    }
    const LevelSetSurvey survey = surveyLevelSet(grid, path, entry.gridClass);
    return describeLevelSet(survey, judge(survey));
}

std::string labelled(const std::string& label, const std::string& text)
{
    constexpr std::size_t kWidth = 11;
    return "\n  " + label + std::string(kWidth - label.size(), ' ') + text;
}

} // namespace vdbounce::tool
