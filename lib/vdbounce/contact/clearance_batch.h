// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/placed_colliders.h"
#include "vdbounce/field/sample_points.h"

#include <vector>

namespace vdbounce {

/// A place that a particle may go to.
struct Candidate {
    Vec3d position;
    double radius = 0.0;
    const PlacedColliders* colliders = nullptr; ///< during its step
    double way = 0.0;                           ///< from where it is, with what colliders move meanwhile
    bool asked = true;                          ///< else nothing is looked up, and the result is 0
    double enough = 0.0;    ///< a clearance that it can do with: no lookup is made to find it larger
    double clearance = 0.0; ///< the result: a lower bound, 0 where it may touch
};

/// How far many particles can move without touching anything, as PlacedColliders::probe() tells of one, by vector code
/// whose cache misses overlap. In single precision, so a little less.
class ClearanceBatch {
public:
    /// Whether no collider changes its form; those that do are not answered.
    static bool answers(const ColliderSet& colliders);

    explicit ClearanceBatch(const ColliderSet& colliders) : colliders_(colliders) {}

    void compute(std::vector<Candidate>& candidates);

private:
    void askOneByOne(std::size_t collider, std::vector<Candidate>& candidates); // for shapes by formula
    void lookUp(std::size_t collider, const DistanceField& field, std::vector<Candidate>& candidates);

    const ColliderSet& colliders_;
    std::vector<std::uint32_t> asked_; // which candidates are looked up
    std::vector<Vec3d> points_;
    std::vector<PointSample> samples_;
};

} // namespace vdbounce
