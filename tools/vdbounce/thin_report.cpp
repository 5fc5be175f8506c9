// SPDX-License-Identifier: Apache-2.0
#include "thin_report.h"

namespace vdbounce::tool {
namespace {

std::string warningOf(const ThinFeatures::Kind& kind, const char* name, const char* consequence, double voxelSize)
{
    const std::string found = counted(kind.voxels, "voxel") + " in " + name +
                              " about as thin as a voxel or thinner, the thinnest near " + vectorText(kind.place);
    if (kind.thinnest < kEdgeVx * voxelSize)
        return found + ", an edge or too thin to tell: " + consequence + "; smaller voxels would help";
    return found + ", " + rounded(kind.thinnest) + " thick (" + rounded(kind.thinnest / voxelSize) +
           " voxels): " + consequence + "; voxels of " + rounded(kind.thinnest / kVoxelsAcross) + " would do";
}

} // namespace

Json thinJson(const ThinFeatures::Kind& kind)
{
    return {{"voxels", kind.voxels}, {"thinnest", kind.thinnest}, {"place", toJson(kind.place)}};
}

std::vector<std::string> thinWarnings(const ThinFeatures& features, double voxelSize)
{
    std::vector<std::string> warnings;
    if (features.walls.voxels > 0)
        warnings.push_back(warningOf(features.walls, "walls or edges", "particles may pass", voxelSize));
    if (features.gaps.voxels > 0)
        warnings.push_back(warningOf(features.gaps, "gaps", "particles may not pass", voxelSize));
    return warnings;
}

} // namespace vdbounce::tool
