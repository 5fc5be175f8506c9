// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"
#include "vdbounce/field/deforming_field.h"
#include "vdbounce/field/distance_field.h"
#include "vdbounce/field/plane_field.h"
#include "vdbounce/implicit/implicit_field.h"

#include <algorithm>
#include <memory>
#include <variant>

/// @file
/// The forms that a collider can have, and what contact asks of each. Points are in the place in which the collider's
/// file has it ("local"). Only shapes that change with time, in seconds, look at it.

namespace vdbounce {

/// Interpolates its two level sets from time `begin` on.
struct DeformingShape {
    std::shared_ptr<const DeformingField> field;
    double begin = 0.0; ///< seconds: when the first of the two holds
    double end = 0.0;   ///< and when the second

    /// How far it is from the first to the second at a time, 0 to 1; see DeformingField.
    double shareAt(double time) const
    {
        return end > begin ? std::clamp((time - begin) / (end - begin), 0.0, 1.0) : 0.0;
    }
};
using Shape = std::variant<PlaneField, std::shared_ptr<const DistanceField>, DeformingShape,
                           std::shared_ptr<const ImplicitField>>;

/// A ball around a shape. Nothing outside touches it.
struct BoundingBall {
    Vec3d centre = Vec3d::Zero();
    double radius = 0.0; ///< infinite for what has no end, and for level sets that their box cuts off
};
BoundingBall ballAround(const Shape& shape);

/// The smallest voxel side, world units; infinite where there are no voxels.
double voxelSizeOf(const Shape& shape);

/// A length on which its walls can be told apart: steps of half of it or less pass none unnoticed. Of level sets the
/// voxel, since the thinnest wall is two voxels thick.
double wallLengthOf(const Shape& shape);

/// Its form changes with time.
bool deforms(const Shape& shape);

/// The farthest that the surface moves from one time to the other, beyond what clearances allow for.
double reachOf(const Shape& shape, double begin, double end);

double phiOf(const Shape& shape, const Vec3d& local, double time);

struct Nearness {
    double phi;
    double clearance; ///< how far a particle can move in any direction without phi falling below its radius, >= 0
};
/// A shape without a surface is infinitely far away.
Nearness nearnessOf(const Shape& shape, const Vec3d& local, double radius, double time);

/// The outward unit normal. phi never decreases along it: where the interpolated central differences point in, as in
/// creases narrower than they reach, the derivative of the interpolated phi takes their place. False where neither
/// tells a direction, which is deep inside or outside a narrow band and where they cancel out.
bool outwardNormal(const Shape& shape, const Vec3d& local, double time, Vec3d& normal);

/// The same where something arrives in `direction`: also the derivative where the central differences, which round off
/// edges, say that it leaves.
bool outwardNormalAgainst(const Shape& shape, const Vec3d& local, double time, const Vec3d& direction, Vec3d& normal);

/// The vector to the nearest place known to be outside. False where none is known.
bool nearestOutsideOf(const Shape& shape, const Vec3d& local, double time, Vec3d& way);

/// How the surface moves as the shape deforms; zero for others.
Vec3d deformationVelocity(const Shape& shape, const Vec3d& local, double time);

} // namespace vdbounce
