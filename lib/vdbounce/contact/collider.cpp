// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/collider.h"

#include <algorithm>
#include <limits>

namespace vdbounce {

ColliderSet::ColliderSet(std::vector<Collider> colliders)
    : colliders_(std::move(colliders)), smallestVoxel_(std::numeric_limits<double>::infinity()),
      wallLength_(std::numeric_limits<double>::infinity())
{
    for (const Collider& collider : colliders_) {
        balls_.push_back(ballAround(collider.shape));
        smallestVoxel_ = std::min(smallestVoxel_, voxelSizeOf(collider.shape));
        wallLength_ = std::min(wallLength_, wallLengthOf(collider.shape));
        still_ = still_ && collider.motion.still() && !collider.body && !deforms(collider.shape);
        anyFree_ = anyFree_ || collider.body.has_value();
    }
}

} // namespace vdbounce
