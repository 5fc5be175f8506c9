// SPDX-License-Identifier: Apache-2.0
#include "describe_level_set.h"

#include "thin_report.h"
#include "transform_words.h"

#include <algorithm>

namespace vdbounce::tool {
namespace {

// Lengths in voxels of bands are multiples of the longest side, of features of the shortest (docs/conventions.md).
double bandVoxel(const LevelSetSurvey& survey) { return survey.transform.voxelSize().maxCoeff(); }
double featureVoxel(const LevelSetSurvey& survey) { return survey.transform.smallestVoxelSize(); }

// Numbers where they are known, else null.
Json known(bool isKnown, double value) { return isKnown ? Json(value) : Json(nullptr); }
Json knownCount(bool isKnown, std::size_t value) { return isKnown ? Json(value) : Json(nullptr); }

void addMeasures(const LevelSetSurvey& survey, const LevelSetMeasures& m, Json& json)
{
    const bool closed = !m.clipped;
    const bool measured = m.eikonal.voxels > 0;
    const ThinFeatures::Smallest& smallest = m.thin.smallest;
    const bool hasSmallest = smallest.thickness > 0.0;
    json["band"] = {{"exterior", m.band.exterior},
                    {"interior", m.band.interior},
                    {"exterior_vx", m.band.exterior / bandVoxel(survey)},
                    {"interior_vx", m.band.interior / bandVoxel(survey)},
                    {"whole_interior", m.band.wholeInterior}};
    json["clipped"] = m.clipped;
    json["closed"] = closed;
    json["steepest"] = m.steepest;
    json["eikonal"] = {{"mean", known(measured, m.eikonal.mean)},
                       {"median", known(measured, m.eikonal.median)},
                       {"largest", known(measured, m.eikonal.largest)},
                       {"where", measured ? toJson(m.eikonal.where) : Json(nullptr)},
                       {"slope", known(measured, m.eikonal.slope)},
                       {"voxels", m.eikonal.voxels},
                       {"off_share", m.eikonal.offShare()},
                       {"crease_share", m.eikonal.creaseShare()}};
    json["components"] = knownCount(closed, m.surface.solids);
    json["cavities"] = knownCount(closed, m.surface.cavities);
    json["volume"] = known(closed, m.surface.volume);
    json["area"] = known(closed, m.surface.area);
    json["area_in_box"] = m.surface.area;
    json["pieces_cut_off"] = m.surface.open;
    json["smallest_feature_vx"] = known(hasSmallest, smallest.thickness / featureVoxel(survey));
    json["smallest_feature"] = hasSmallest ? Json({{"kind", smallest.wall ? "wall" : "gap"},
                                                   {"thickness", smallest.thickness},
                                                   {"place", toJson(smallest.place)}})
                                           : Json(nullptr);
    json["thin_walls"] = thinJson(m.thin.walls);
    json["thin_gaps"] = thinJson(m.thin.gaps);
}

Json jsonOf(const LevelSetSurvey& survey)
{
    const LevelSetSummary& s = survey.summary;
    Json json = {{"kind", "level set"},
                 {"name", s.name},
                 {"type", s.valueType},
                 {"class", survey.gridClass},
                 {"voxel_size", toJson(s.voxelSize)},
                 {"transform", transformJson(survey.transform)},
                 {"background", s.background},
                 {"half_width_vx", s.halfWidthVx},
                 {"active_voxels", s.activeVoxels},
                 {"memory_bytes", s.memoryBytes},
                 {"box_min", toJson(s.worldBox.min)},
                 {"box_max", toJson(s.worldBox.max)}};
    if (survey.measures) addMeasures(survey, *survey.measures, json);
    return json;
}

// "3 voxels outside (0.3) and 2 inside (0.2)"
std::string bandText(const LevelSetSurvey& survey, const Band& band)
{
    const std::string outside =
        rounded(band.exterior / bandVoxel(survey)) + " voxels outside (" + rounded(band.exterior) + ")";
    if (band.wholeInterior && band.interior == 0.0) return outside;
    return outside + (band.wholeInterior ? ", all of the inside, to " : ", ") +
           rounded(band.interior / bandVoxel(survey)) + " inside (" + rounded(band.interior) + ")";
}

std::string surfaceText(const LevelSetMeasures& m)
{
    const SurfaceMeasure& surface = m.surface;
    if (surface.pieces.empty()) return m.clipped ? "none in its box, all of which is inside" : "none";
    const std::string cavities =
        surface.cavities == 0 ? ""
                              : ", " + grouped(surface.cavities) + (surface.cavities == 1 ? " cavity" : " cavities");
    if (m.clipped)
        return "cut off by its box in " + counted(surface.open, "piece") +
               (surface.solids == 0 ? "" : ", beside " + counted(surface.solids, "closed solid")) + cavities +
               "; area " + rounded(surface.area) + " in the box, volume not known";
    return "closed, " + counted(surface.solids, "solid") + cavities + "; area " + rounded(surface.area) + ", volume " +
           rounded(surface.volume);
}

std::string distancesText(const EikonalResidual& eikonal)
{
    if (eikonal.voxels == 0) return "none that could be checked: no voxel and its neighbours are in the band";
    std::string text = "|grad phi| is off 1 by " + rounded(eikonal.mean) + " on average, at most by " +
                       rounded(eikonal.largest) + " at " + vectorText(eikonal.where);
    if (eikonal.offVoxels > 0) text += "; by a tenth or more in " + percentText(eikonal.offShare()) + " of the voxels";
    return text;
}

std::string detailText(const LevelSetSurvey& survey, const LevelSetMeasures& m)
{
    const ThinFeatures::Smallest& smallest = m.thin.smallest;
    if (smallest.thickness == 0.0)
        return "no wall or gap as thin as " +
               rounded(2.0 * std::min(m.band.exterior, m.band.interior) / featureVoxel(survey)) +
               " voxels, twice the band";
    return std::string("the thinnest ") + (smallest.wall ? "wall" : "gap") + " is " +
           rounded(smallest.thickness / featureVoxel(survey)) + " voxels thick (" + rounded(smallest.thickness) +
           ") at " + vectorText(smallest.place);
}

std::string measuresText(const LevelSetSurvey& survey, const LevelSetMeasures& m)
{
    std::string text = labelled("band", bandText(survey, m.band)) + labelled("surface", surfaceText(m)) +
                       labelled("distances", distancesText(m.eikonal));
    if (!m.surface.pieces.empty()) text += labelled("detail", detailText(survey, m));
    for (const std::string& warning : thinWarnings(m.thin, featureVoxel(survey))) text += labelled("warning", warning);
    return text;
}

} // namespace

Description describeLevelSet(const LevelSetSurvey& survey, const Verdict& verdict)
{
    const LevelSetSummary& s = survey.summary;
    Json json = jsonOf(survey);
    addVerdict(verdict, json);
    std::string text = "level set '" + s.name + "': " + verdict.sentence();
    text += labelled("grid", "class '" + survey.gridClass + "', " + s.valueType + ", " +
                                 counted(s.activeVoxels, "active voxel") + ", " + bytesText(double(s.memoryBytes)));
    text += labelled("voxels", transformWords(survey.transform));
    if (!s.worldBox.empty()) text += labelled("box", vectorText(s.worldBox.min) + " to " + vectorText(s.worldBox.max));
    if (survey.measures) text += measuresText(survey, *survey.measures);
    for (std::size_t i = 1; i < verdict.faults.size(); ++i)
        text += labelled("also", verdict.faults[i].what + "; " + verdict.faults[i].remedy);
    return {json, text};
}

} // namespace vdbounce::tool
