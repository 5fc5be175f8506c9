// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/particle_pass.h"
#include "vdbounce/field/distance_field.h"
#include "vdbounce/particles/particles.h"

#include <string>

/// @file
/// How wide a level set's narrow band must be for the particles that touch it: beyond it phi is not known, so that
/// touching at phi = radius would go unnoticed, as would coming within the range of repulsion.

namespace vdbounce {

/// How far from a surface particles meet it.
struct ContactReach {
    double radius = 0.0;    ///< of the largest particle, world units
    double repulsion = 0.0; ///< its range, world units
    double total() const { return radius + repulsion; }
};
ContactReach contactReach(const Particles& particles, const ParticleDefaults& defaults, const StepOptions& options);

/// The width on the side that is touched, world units; 0 for points that nothing repels.
double neededBand(const DistanceField& field, const ContactReach& reach);

/// Throws InputError where `band`, that on the `side` ("exterior") that is touched, is less, naming the one that would
/// do.
void requireBand(const DistanceField& field, double band, const std::string& file, const std::string& side,
                 const ContactReach& reach);

} // namespace vdbounce
