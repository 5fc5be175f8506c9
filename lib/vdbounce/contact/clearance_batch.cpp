// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/clearance_batch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vdbounce {
namespace {

// How far phi in single precision may be off, as a share of itself and a voxel's diagonal: samplePoints() promises 16
// units in the last place of a voxel's value nearby, this is a hundred.
constexpr double kSinglePrecision = 6e-6;

} // namespace

bool ClearanceBatch::answers(const ColliderSet& colliders)
{
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        if (deforms(colliders[i].shape)) return false;
    }
    return true;
}

void ClearanceBatch::compute(std::vector<Candidate>& candidates)
{
    for (Candidate& candidate : candidates)
        candidate.clearance = candidate.asked ? std::numeric_limits<double>::infinity() : 0.0;
    for (std::size_t c = 0; c < colliders_.size(); ++c) {
        const auto* field = std::get_if<std::shared_ptr<const DistanceField>>(&colliders_[c].shape);
        if (field == nullptr) {
            askOneByOne(c, candidates);
        } else if (!(*field)->empty()) {
            lookUp(c, **field, candidates);
        }
    }
}

void ClearanceBatch::askOneByOne(std::size_t collider, std::vector<Candidate>& candidates)
{
    for (Candidate& candidate : candidates) {
        if (!(candidate.clearance > 0.0)) continue;
        const Placement& placement = candidate.colliders->placement(collider);
        const Vec3d local = placement.moves ? placement.end.toLocal(candidate.position) : candidate.position;
        const Nearness near = nearnessOf(colliders_[collider].shape, local, candidate.radius, placement.endTime);
        candidate.clearance = std::min(candidate.clearance, near.clearance);
    }
}

void ClearanceBatch::lookUp(std::size_t collider, const DistanceField& field, std::vector<Candidate>& candidates)
{
    asked_.clear();
    points_.clear();
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        Candidate& candidate = candidates[i];
        if (!(candidate.clearance > 0.0)) continue;
        const Placement& placement = candidate.colliders->placement(collider);
        const Vec3d local = placement.moves ? placement.end.toLocal(candidate.position) : candidate.position;
        if (!field.clipped()) {
            // What is outside of the box is at least as far from the surface.
            const double squared = distanceSquared(field.worldBox(), local);
            const double away = squared > 0.0 ? std::sqrt(squared) - candidate.radius : 0.0;
            if (away > 0.0 && (away >= candidate.enough || away >= candidate.clearance)) {
                candidate.clearance = std::min(candidate.clearance, away);
                continue;
            }
        }
        asked_.push_back(std::uint32_t(i));
        points_.push_back(local);
    }
    samples_.resize(points_.size());
    samplePoints(field, points_.data(), points_.size(), samples_.data(), Normal::Analytic);
    const double diagonal = field.transform().voxelDiagonal();
    for (std::size_t k = 0; k < asked_.size(); ++k) {
        Candidate& candidate = candidates[asked_[k]];
        const double phi = double(samples_[k].phi);
        const double least = phi - kSinglePrecision * (std::abs(phi) + diagonal);
        candidate.clearance = std::min(candidate.clearance, field.clearance(points_[k], least, candidate.radius));
    }
}

} // namespace vdbounce
