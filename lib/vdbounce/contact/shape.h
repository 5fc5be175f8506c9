// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"
#include "vdbounce/field/deforming_field.h"
#include "vdbounce/field/distance_field.h"
#include "vdbounce/field/plane_field.h"

#include <memory>
#include <variant>

/// @file
/// The forms that a collider can have, and what contact asks of each. Points are in the place in which the collider's
/// file has it ("local"); `share` is a deforming shape's time, see DeformingField.

namespace vdbounce {

/// Interpolates its two level sets from time `begin` on.
struct DeformingShape {
    std::shared_ptr<const DeformingField> field;
    double begin = 0.0; ///< seconds: when the first of the two holds
    double end = 0.0;   ///< and when the second
};
using Shape = std::variant<PlaneField, std::shared_ptr<const DistanceField>, DeformingShape>;

/// A ball around a shape. Nothing outside touches it.
struct BoundingBall {
    Vec3d centre = Vec3d::Zero();
    double radius = 0.0; ///< infinite for planes, and for level sets that their box cuts off
};
BoundingBall ballAround(const Shape& shape);

/// The smallest voxel side, world units; infinite where there are no voxels.
double voxelSizeOf(const Shape& shape);

/// A deforming shape's share at a time; 0 for others.
double shareAt(const Shape& shape, double time);

struct Nearness {
    double phi;
    double clearance; ///< how far a particle can move in any direction without phi falling below its radius, >= 0
};
/// A shape without a surface is infinitely far away.
Nearness nearnessOf(const Shape& shape, const Vec3d& local, double radius, double share);

/// The outward unit normal. phi never decreases along it: where the interpolated central differences point in, as in
/// creases narrower than they reach, the derivative of the interpolated phi takes their place. False where neither
/// tells a direction, which is deep inside or outside a narrow band and where they cancel out.
bool outwardNormal(const Shape& shape, const Vec3d& local, double share, Vec3d& normal);

/// The same where something arrives in `direction`: also the derivative where the central differences, which round off
/// edges, say that it leaves.
bool outwardNormalAgainst(const Shape& shape, const Vec3d& local, double share, const Vec3d& direction, Vec3d& normal);

/// The vector to the nearest place known to be outside. False where none is known.
bool nearestOutsideOf(const Shape& shape, const Vec3d& local, Vec3d& way);

/// How the surface moves as the shape deforms; zero for others.
Vec3d deformationVelocity(const Shape& shape, const Vec3d& local, double share);

} // namespace vdbounce
