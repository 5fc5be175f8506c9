// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/option_checks.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/voxel_limits.h"
#include "vdbounce/io/number_text.h"

#include <cmath>

namespace vdbounce {

void requireInRange(bool good, const char* name, double value, const std::string& remedy)
{
    if (!good) throw UsageError(name, numberText(value) + " is out of range", remedy);
}

void requireVoxelSize(double voxel, const std::string& subject)
{
    requireInRange(voxel > 0.0 && std::isfinite(voxel), "voxel size", voxel, "give a positive length");
    const std::string remedy = "OpenVDB's transforms hold no smaller voxels than 1.5e-5; scale the " + subject + " up";
    requireInRange(voxel >= kSmallestVoxel, "voxel size", voxel, remedy);
}

void requireBand(const char* name, double halfWidthVx)
{
    requireInRange(halfWidthVx >= kNarrowestBandVx && halfWidthVx < kWidestBandVx, name, halfWidthVx,
                   "give at least 1 voxel");
}

void refuseFarVoxels(double voxel, double farthest, const std::string& subject, const std::string& it)
{
    throw UsageError("voxel size " + numberText(voxel),
                     "is too small for " + subject + " reaches " + numberText(std::round(farthest)) +
                         " voxels from the origin; 1,073,741,824 are the most",
                     "use larger voxels or move " + it + " to the origin");
}

} // namespace vdbounce
