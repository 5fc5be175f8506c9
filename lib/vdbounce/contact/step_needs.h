// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/step.h"

namespace vdbounce {

/// What the steps of a scene may have to look at. The step is one body, compiled once for each of the variants below,
/// which leave out what a scene cannot need. What is left out would have changed no bit.
struct StepNeeds {
    bool motion = true;    ///< some collider moves, deforms or is moved by particles
    bool several = true;   ///< there is more than one collider
    bool friction = true;  ///< some collider has any
    bool taking = true;    ///< some collider keeps or deletes what touches it
    bool repulsion = true; ///< there is a force within a range of surfaces
    bool hits = true;      ///< hits are written down

    /// Whether a step that looks at these does for a scene that needs those.
    constexpr bool cover(const StepNeeds& needed) const
    {
        return (motion || !needed.motion) && (several || !needed.several) && (friction || !needed.friction) &&
               (taking || !needed.taking) && (repulsion || !needed.repulsion) && (hits || !needed.hits);
    }
};

StepNeeds needsOf(const ColliderSet& colliders, const StepOptions& options, bool hits);

/// The variants, from the barest to the one that looks at everything.
constexpr StepNeeds kStepVariants[] = {
    {false, false, false, false, false, false}, // one smooth collider that stands still
    {false, false, true, false, false, false},  // one that stands still
    {false, true, true, true, true, true},      // any that stand still
    {},
};

/// The one that looks at everything.
constexpr int kWholeStep = 3;

/// The first of the variants that covers what is needed.
constexpr int stepVariantFor(const StepNeeds& needed)
{
    int variant = 0;
    while (!kStepVariants[variant].cover(needed)) ++variant;
    return variant;
}

/// As step() does it, by one of the variants, which must cover what is needed.
using StepFunction = void (*)(MovingParticle&, const PlacedColliders&, const StepOptions&, StepTally&);
StepFunction stepOfVariant(int variant);

} // namespace vdbounce
