// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/implicit_field.h"

#include <Eigen/Geometry>

#include <memory>
#include <optional>
#include <string>
#include <variant>

/// @file
/// The shapes that have a formula for their signed distance (lecture, slides 13 and 17), as users describe them. World
/// units; directions and rotations of any length but 0.

namespace vdbounce {

/// The half space behind a plane.
struct PlaneShape {
    Vec3d point = Vec3d::Zero();
    Vec3d normal = Vec3d(0.0, 1.0, 0.0); ///< points out
};

struct SphereShape {
    Vec3d centre = Vec3d::Zero();
    double radius = 1.0;
};

struct BoxShape {
    Vec3d centre = Vec3d::Zero();
    Vec3d half = Vec3d::Ones(); ///< half its sides
    Eigen::Quaterniond rotate = Eigen::Quaterniond::Identity();
};

/// All that is within `radius` of the line from one point to the other.
struct CapsuleShape {
    Vec3d from = Vec3d::Zero();
    Vec3d to = Vec3d(0.0, 1.0, 0.0); ///< may be `from`
    double radius = 1.0;
};

struct CylinderShape {
    Vec3d from = Vec3d::Zero(); ///< the middle of one end
    Vec3d to = Vec3d(0.0, 1.0, 0.0);
    double radius = 1.0;
};

struct ConeShape {
    Vec3d from = Vec3d::Zero();      ///< the middle of its base
    Vec3d to = Vec3d(0.0, 1.0, 0.0); ///< its tip, or the middle of its top
    double radius = 1.0;             ///< of the base
    double topRadius = 0.0;          ///< >= 0; 0: a tip
};

struct TorusShape {
    Vec3d centre = Vec3d::Zero();
    Vec3d axis = Vec3d(0.0, 1.0, 0.0);
    double major = 1.0;  ///< from the centre to the middle of the tube
    double minor = 0.25; ///< of the tube; less than `major`
};

struct EllipsoidShape {
    Vec3d centre = Vec3d::Zero();
    Vec3d radii = Vec3d::Ones(); ///< along x, y and z
};

using ShapeFormula =
    std::variant<PlaneShape, SphereShape, BoxShape, CapsuleShape, CylinderShape, ConeShape, TorusShape, EllipsoidShape>;

/// The shape's field: exact distance and normal everywhere, to some units in the last place of its coordinates.
/// Cost: some 5 to 20 nanoseconds a lookup, the ellipsoid 100.
///
///     auto ball = makeField(SphereShape{Vec3d(0, 1, 0), 0.5});
///     double phi = ball->phi(Vec3d(0, 2, 0), 0.0); // 0.5
///
/// Throws UsageError for a shape with a fault.
std::shared_ptr<const ImplicitField> makeField(const ShapeFormula& shape);

/// A value that is not finite or makes a shape of no size, by its name in scenes: "radius".
struct ShapeFault {
    std::string name;
    std::string what;
    std::string remedy;
};
std::optional<ShapeFault> findFault(const ShapeFormula& shape);

/// "plane", "sphere", ...
const char* nameOf(const ShapeFormula& shape);

} // namespace vdbounce
