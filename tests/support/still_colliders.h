// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/placed_colliders.h"

namespace vdbounce::test {

/// Colliders that do not move, with the one placement that they need.
class StillColliders {
public:
    explicit StillColliders(std::vector<Collider> colliders) : set_(std::move(colliders)), placed_(set_) {}
    StillColliders(const StillColliders&) = delete;
    StillColliders& operator=(const StillColliders&) = delete;

    operator const ColliderSet&() const { return set_; }
    operator const PlacedColliders&() const { return placed_; }

    std::size_t size() const { return set_.size(); }
    Probe probe(const Vec3d& position, double radius) const { return placed_.probe(position, radius); }

private:
    ColliderSet set_;
    PlacedColliders placed_;
};

} // namespace vdbounce::test
