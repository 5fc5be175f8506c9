// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"

#include <algorithm>
#include <limits>

namespace vdbounce {

/// What of a cell of a heightfield is nearest to a point: one of its two triangles, or an edge with its ends.
/// "Right" is the triangle that has the sample of the next column, "left" the other.
enum class HeightCellPart { FaceRight, FaceLeft, EdgeFront, EdgeRight, EdgeBack, EdgeLeft, Diagonal };

struct HeightCellNearest {
    double distance2;
    HeightCellPart part;
};

/// The two triangles of a cell of a heightfield, cut along the diagonal between samples (i, j) and (i + 1, j + 1), with
/// lengths from the first of them. World units.
///
/// Slopes rather than corners: the foot of a point on a triangle's plane, and whether it is within the triangle, then
/// have no cancellation however steep the triangle is. Where the foot is outside, the nearest point is on one of the
/// edges that it is outside of (Ericson, Real-Time Collision Detection, 5.1.5).
struct HeightCell {
    double stepX;
    double stepZ;
    double right; ///< heights of the other three corners above the first: (i + 1, j),
    double far;   ///< (i + 1, j + 1),
    double left;  ///< (i, j + 1)

    /// The upward normal of a triangle, not of length 1.
    Vec3d normal(bool ofRight) const
    {
        return ofRight ? Vec3d(-right / stepX, 1.0, (right - far) / stepZ)
                       : Vec3d((left - far) / stepX, 1.0, -left / stepZ);
    }

    /// Where the upright through a point's foot on the right triangle's plane passes.
    Vec3d foot(const Vec3d& p) const
    {
        const Foot found(p, right / stepX, (far - right) / stepZ);
        return Vec3d(found.x, 0.0, found.z);
    }

    /// From the nearest point of an edge to a point.
    Vec3d awayFrom(HeightCellPart edge, const Vec3d& p) const
    {
        switch (edge) {
        case HeightCellPart::EdgeFront: return away(p, Vec3d::Zero(), Vec3d(stepX, right, 0.0));
        case HeightCellPart::EdgeRight: return away(p, Vec3d(stepX, right, 0.0), Vec3d(0.0, far - right, stepZ));
        case HeightCellPart::EdgeBack: return away(p, Vec3d(0.0, left, stepZ), Vec3d(stepX, far - left, 0.0));
        case HeightCellPart::EdgeLeft: return away(p, Vec3d::Zero(), Vec3d(0.0, left, stepZ));
        default: return away(p, Vec3d::Zero(), Vec3d(stepX, far, stepZ));
        }
    }

    /// Infinitely far where it is farther than the root of `limit2` for certain.
    HeightCellNearest nearest(const Vec3d& p, double limit2) const
    {
        HeightCellNearest best = nearestOfRight(p, limit2);
        const HeightCellNearest other = nearestOfLeft(p, limit2);
        if (other.distance2 < best.distance2) best = other;
        return best;
    }

private:
    static constexpr double kFar = std::numeric_limits<double>::infinity();

    static Vec3d away(const Vec3d& p, const Vec3d& start, const Vec3d& along)
    {
        const Vec3d from = p - start;
        const double share = std::min(1.0, std::max(0.0, from.dot(along) / along.squaredNorm()));
        return from - share * along;
    }

    void consider(HeightCellNearest& best, HeightCellPart edge, const Vec3d& p) const
    {
        const double distance2 = awayFrom(edge, p).squaredNorm();
        if (distance2 < best.distance2) best = {distance2, edge};
    }

    // A point's foot on the plane of a triangle, and its distance to the plane.
    struct Foot {
        double x;
        double z;
        double distance2;

        Foot(const Vec3d& p, double slopeX, double slopeZ)
        {
            const double above = p.y() - slopeX * p.x() - slopeZ * p.z();
            const double t = above / (1.0 + slopeX * slopeX + slopeZ * slopeZ);
            x = p.x() + slopeX * t;
            z = p.z() + slopeZ * t;
            distance2 = above * t;
        }
    };

    // On the plane it is at least as far from the foot to the cell as it is seen from above.
    bool isWithin(const Foot& foot, double limit2) const
    {
        const double x = std::max(0.0, std::max(-foot.x, foot.x - stepX));
        const double z = std::max(0.0, std::max(-foot.z, foot.z - stepZ));
        return foot.distance2 + x * x + z * z <= limit2;
    }

    // Where the diagonal is nearest, it is found as the left triangle's.
    HeightCellNearest nearestOfRight(const Vec3d& p, double limit2) const
    {
        const Foot foot(p, right / stepX, (far - right) / stepZ);
        HeightCellNearest best{kFar, HeightCellPart::EdgeFront};
        if (!isWithin(foot, limit2)) return best;
        const bool beyondDiagonal = foot.z * stepX > foot.x * stepZ;
        if (foot.z >= 0.0 && foot.x <= stepX && !beyondDiagonal) return {foot.distance2, HeightCellPart::FaceRight};
        if (foot.z < 0.0) consider(best, HeightCellPart::EdgeFront, p);
        if (foot.x > stepX) consider(best, HeightCellPart::EdgeRight, p);
        return best;
    }

    HeightCellNearest nearestOfLeft(const Vec3d& p, double limit2) const
    {
        const Foot foot(p, (far - left) / stepX, left / stepZ);
        HeightCellNearest best{kFar, HeightCellPart::Diagonal};
        if (!isWithin(foot, limit2)) return best;
        const bool beyondDiagonal = foot.z * stepX < foot.x * stepZ;
        if (foot.x >= 0.0 && foot.z <= stepZ && !beyondDiagonal) return {foot.distance2, HeightCellPart::FaceLeft};
        if (beyondDiagonal) consider(best, HeightCellPart::Diagonal, p);
        if (foot.x < 0.0) consider(best, HeightCellPart::EdgeLeft, p);
        if (foot.z > stepZ) consider(best, HeightCellPart::EdgeBack, p);
        return best;
    }
};

} // namespace vdbounce
