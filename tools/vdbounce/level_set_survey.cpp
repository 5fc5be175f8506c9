// SPDX-License-Identifier: Apache-2.0
#include "level_set_survey.h"

#include "vdbounce/field/grid_transform.h"

#include <algorithm>
#include <cmath>

namespace vdbounce::tool {
namespace {

// 500 MB of blocks for the sides of tiles, where no surface of a level set lies.
constexpr std::uint64_t kMostBareLeaves = 100000;

LevelSetMeasures measure(const LevelSetGrid& grid, const ValueRange& range)
{
    const DistanceField field(grid);
    LevelSetMeasures measures;
    measures.band.exterior = field.background();
    measures.band.wholeInterior = !std::isfinite(field.interior());
    measures.band.interior = measures.band.wholeInterior ? std::max(0.0, -double(range.lowest)) : field.interior();
    measures.clipped = field.clipped();
    measures.steepest = field.lipschitz();
    measures.eikonal = eikonalResidual(field);
    measures.surface = measureSurface(field);
    measures.thin = thinFeatures(grid);
    return measures;
}

} // namespace

LevelSetSurvey surveyLevelSet(const LevelSetGrid& grid, const std::string& path, const std::string& gridClass)
{
    LevelSetSurvey survey;
    survey.path = path;
    survey.gridClass = gridClass;
    survey.summary = summarize(grid);
    survey.transform = transformOf(grid);
    survey.range = valueRange(toScalarGrid(grid));
    if (survey.range.notFinite == 0 && survey.range.bareLeaves <= kMostBareLeaves)
        survey.measures = measure(grid, survey.range);
    return survey;
}

} // namespace vdbounce::tool
