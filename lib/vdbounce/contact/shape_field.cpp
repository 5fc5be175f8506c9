// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/shape_field.h"

#include "vdbounce/contact/motion_reach.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vdbounce {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const Box kEverywhere{Vec3d::Constant(-kInfinity), Vec3d::Constant(kInfinity)};

// What a search along a path may miss of a level set, voxels.
constexpr double kResolutionVx = 0.25;

using FieldPtr = std::shared_ptr<const DistanceField>;
using ImplicitPtr = std::shared_ptr<const ImplicitField>;

class ShapeField final : public ImplicitField {
public:
    ShapeField(const Shape& shape, const Motion& motion) : shape_(shape), motion_(motion), ball_(ballAround(shape)) {}

    double phi(const Vec3d& world, double time) const override { return phiOf(shape_, toLocal(world, time), time); }

    FieldSample sample(const Vec3d& world, double time) const override
    {
        const Vec3d local = toLocal(world, time);
        FieldSample result{phiOf(shape_, local, time), Vec3d::Zero()};
        if (outwardNormal(shape_, local, time, result.gradient) && !motion_.still())
            result.gradient = motion_.poseAt(time).vectorToWorld(result.gradient);
        return result;
    }

    void phiInRow(const Vec3d& from, const Vec3d& step, int count, double time, double* out) const override
    {
        for (int i = 0; i < count; ++i) out[i] = phi(from + double(i) * step, time);
    }

    bool exact() const override { return false; } // sampled, for all that is known here

    Box box() const override
    {
        if (!motion_.still() || !std::isfinite(ball_.radius)) return kEverywhere;
        if (const auto* implicit = std::get_if<ImplicitPtr>(&shape_)) return (*implicit)->box();
        return {ball_.centre - Vec3d::Constant(ball_.radius), ball_.centre + Vec3d::Constant(ball_.radius)};
    }

    double thinnestWall() const override
    {
        const auto* implicit = std::get_if<ImplicitPtr>(&shape_);
        return implicit != nullptr ? (*implicit)->thinnestWall() : kInfinity; // the voxel limits it otherwise
    }

    double resolution() const override
    {
        if (const auto* implicit = std::get_if<ImplicitPtr>(&shape_)) return (*implicit)->resolution();
        return kResolutionVx * voxelSizeOf(shape_);
    }

    double clearance(const Vec3d& world, double radius, double time) const override
    {
        return nearnessOf(shape_, toLocal(world, time), radius, time).clearance;
    }

    double clearanceInside(const Vec3d& world, double radius, double time) const override
    {
        // Where its box cuts a level set off, phi jumps on the way out of the box.
        if (!std::isfinite(ball_.radius) && voxelSizeOf(shape_) < kInfinity) return 0.0;
        if (const auto* implicit = std::get_if<ImplicitPtr>(&shape_))
            return (*implicit)->clearanceInside(toLocal(world, time), radius, time);
        return ImplicitField::clearanceInside(world, radius, time);
    }

    double lipschitz() const override
    {
        if (const auto* field = std::get_if<FieldPtr>(&shape_)) return (*field)->lipschitz();
        if (const auto* deforming = std::get_if<DeformingShape>(&shape_)) return deforming->field->lipschitz();
        if (const auto* implicit = std::get_if<ImplicitPtr>(&shape_)) return (*implicit)->lipschitz();
        return 1.0;
    }

    double voxelSize() const override { return voxelSizeOf(shape_); }

    bool wayOutside(const Vec3d& world, double time, Vec3d& way) const override
    {
        if (!nearestOutsideOf(shape_, toLocal(world, time), time, way)) return false;
        if (!motion_.still()) way = motion_.poseAt(time).vectorToWorld(way);
        return true;
    }

    bool still() const override { return motion_.still() && !deforms(shape_); }

    Vec3d velocity(const Vec3d& world, double time) const override
    {
        if (motion_.still()) return deformationVelocity(shape_, world, time);
        const Pose pose = motion_.poseAt(time);
        return motion_.velocityAt(time).at(world) +
               pose.vectorToWorld(deformationVelocity(shape_, pose.toLocal(world), time));
    }

    double reach(double begin, double end) const override
    {
        const double deforming = reachOf(shape_, begin, end);
        if (motion_.still()) return deforming;
        return deforming +
               motionReach(motion_.poseAt(begin), motion_.poseAt(end), motion_.velocityAt(end), ball_, end - begin);
    }

private:
    Vec3d toLocal(const Vec3d& world, double time) const
    {
        return motion_.still() ? world : motion_.poseAt(time).toLocal(world);
    }

    Shape shape_;
    Motion motion_;
    BoundingBall ball_;
};

} // namespace

std::shared_ptr<const ImplicitField> asField(const Shape& shape, const Motion& motion)
{
    return std::make_shared<const ShapeField>(shape, motion);
}

} // namespace vdbounce
