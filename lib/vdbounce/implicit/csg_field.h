// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/csg_operation.h"
#include "vdbounce/implicit/implicit_field.h"

#include <memory>
#include <vector>

namespace vdbounce {

/// Fields combined by set operations (lecture, slide 17): min and max of their values, or smooth ones that round the
/// edge (see combine()). Of several operands the first is combined with the second, the result with the third and so
/// on; Subtraction takes all others from the first; Complement has one.
///
/// The surface is exact. phi is a distance wherever the nearest place of the surface belongs to the operand that
/// decides; elsewhere, which is inside unions and outside intersections and subtractions near their edges, the surface
/// is farther than |phi|, and where edges are rounded the gradient is shorter than 1. Where operands move, so does the
/// result. Cost: that of all operands.
class CsgField final : public ImplicitField {
public:
    /// `blend`: the width, in phi, over which edges are rounded; world units, >= 0. Throws UsageError for a blend out
    /// of range and for a number of operands that the operation does not have.
    CsgField(CsgOperation operation, std::vector<std::shared_ptr<const ImplicitField>> operands, double blend = 0.0);

    double phi(const Vec3d& world, double time) const override;
    FieldSample sample(const Vec3d& world, double time) const override;
    void phiInRow(const Vec3d& from, const Vec3d& step, int count, double time, double* out) const override;
    bool exact() const override { return false; }
    Box box() const override;
    double thinnestWall() const override;
    double resolution() const override;
    double clearance(const Vec3d& world, double radius, double time) const override;
    double clearanceInside(const Vec3d& world, double radius, double time) const override;
    double lipschitz() const override;
    double voxelSize() const override;
    bool convex() const override;
    bool wayOutside(const Vec3d& world, double time, Vec3d& way) const override;
    bool still() const override;
    Vec3d velocity(const Vec3d& world, double time) const override;
    double reach(double begin, double end) const override;

private:
    CsgOperation operation_;
    std::vector<std::shared_ptr<const ImplicitField>> operands_;
    double blend_;
};

} // namespace vdbounce
