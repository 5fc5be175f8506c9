// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/step.h"

#include "vdbounce/contact/collide_contact.h"

namespace vdbounce {

void settle(MovingParticle& particle, const ColliderSet& colliders)
{
    const Probe probe = colliders.probe(particle.position, particle.radius);
    particle.clearance = probe.clearance;
    particle.inside = probe.gap < 0.0;
}

void step(MovingParticle& particle, const ColliderSet& colliders, const StepOptions& options, StepTally& tally)
{
    CollideContact(particle, colliders, options, tally).run();
}

} // namespace vdbounce
