// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/step_tally.h"

#include <algorithm>

namespace vdbounce {

StepTally::StepTally(std::size_t colliders)
    : impulse(colliders, Vec3d::Zero()), angularImpulse(colliders, Vec3d::Zero())
{
}

StepTally& StepTally::operator+=(const StepTally& other)
{
    free += other.free;
    near += other.near;
    contacts += other.contacts;
    swept += other.swept;
    unresolved += other.unresolved;
    maxPenetration = std::max(maxPenetration, other.maxPenetration);
    for (std::size_t i = 0; i < impulse.size(); ++i) {
        impulse[i] += other.impulse[i];
        angularImpulse[i] += other.angularImpulse[i];
    }
    return *this;
}

} // namespace vdbounce
