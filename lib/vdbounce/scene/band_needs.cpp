// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/scene/band_needs.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/number_text.h"

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

// Trilinear lookup and central differences at phi = radius use voxels up to two cells further out.
constexpr double kLookupReachVx = 2.0;

} // namespace

ContactReach contactReach(const Particles& particles, const ParticleDefaults& defaults, const StepOptions& options)
{
    ContactReach reach{particles.radius.empty() ? defaults.radius : 0.0, options.repulsion.range};
    for (double radius : particles.radius) {
        if (std::isfinite(radius)) reach.radius = std::max(reach.radius, radius);
    }
    return reach;
}

double neededBand(const DistanceField& field, const ContactReach& reach)
{
    return reach.total() > 0.0 ? reach.total() + kLookupReachVx * field.voxelSize() : 0.0;
}

void requireBand(const DistanceField& field, double band, const std::string& file, const std::string& side,
                 const ContactReach& reach)
{
    const double needed = neededBand(field, reach);
    if (field.empty() || band >= needed * (1.0 - 1e-6)) return;
    throw InputError(file,
                     "its narrow band of " + numberText(band) + " is too thin for a particle radius of " +
                         numberText(reach.radius) +
                         (reach.repulsion > 0.0 ? " and repulsion from " + numberText(reach.repulsion) + " on" : ""),
                     "make it with --" + side + " " + numberText(std::ceil(needed / field.voxelSize())) + "vx or more");
}

} // namespace vdbounce
