// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"
#include "vdbounce/base/vector.h"
#include "vdbounce/field/stencil.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace vdbounce {

/// A surface given by a function of place and time: inside where phi < 0 (lecture, slides 14 to 17). Shapes by formula,
/// CSG of other fields. Read-only and safe to use from any number of threads.
///
/// phi is in world units, negative inside, and never exaggerates: the surface is at least |phi| away. Where exact() it
/// is the signed distance. Points are in world space, times in seconds; fields that do not move ignore them.
class ImplicitField {
public:
    static constexpr int kLongestRow = 16;

    virtual ~ImplicitField() = default;

    virtual double phi(const Vec3d& world, double time) const = 0;

    /// phi, and its gradient: of length 1, pointing out, also inside; shorter where CSG rounds an edge. At points with
    /// several nearest places of the surface (a sphere's centre, a box's diagonals) that of one of them. Zero only
    /// where no direction is known, as deep in a level set's narrow band.
    virtual FieldSample sample(const Vec3d& world, double time) const = 0;

    /// phi at `count` points in a row, kLongestRow at most: out[i] is phi(from + i * step), to the bit.
    virtual void phiInRow(const Vec3d& from, const Vec3d& step, int count, double time, double* out) const = 0;

    /// phi is the signed distance everywhere.
    virtual bool exact() const { return true; }

    /// A world box around the inside, at all times; with infinite sides where it has no end.
    virtual Box box() const = 0;

    /// No wall of it is thinner than this, but at edges and tips, world units; 0 where that is not known. Particles
    /// that move much less in a step need no search along their path.
    virtual double thinnestWall() const = 0;

    /// A search along a path may miss what is shorter along it than this, world units: so deep it cuts off edges.
    virtual double resolution() const { return thinnestWall() / 256.0; }

    /// How far a particle can move in any direction, at that time, without phi falling below its radius; >= 0.
    virtual double clearance(const Vec3d& world, double radius, double time) const
    {
        return std::max(0.0, phi(world, time) - radius) / lipschitz();
    }

    /// The same of its complement: without -phi falling below the radius.
    virtual double clearanceInside(const Vec3d& world, double radius, double time) const
    {
        return std::max(0.0, -phi(world, time) - radius) / lipschitz();
    }

    /// No two points differ in phi by more than this times their distance; at least 1.
    virtual double lipschitz() const { return 1.0; }

    /// The side of the smallest voxel that it is made of, world units; infinite where it is made of none.
    virtual double voxelSize() const { return std::numeric_limits<double>::infinity(); }

    /// phi is convex at all times: along a straight line it falls, then rises, and stays above its tangents. True of
    /// signed distances of convex bodies.
    virtual bool convex() const { return false; }

    /// A vector to a place outside, where phi > 0; false where none is known.
    virtual bool wayOutside(const Vec3d& /*world*/, double /*time*/, Vec3d& /*way*/) const { return false; }

    /// The surface never moves.
    virtual bool still() const { return true; }

    /// Velocity of the surface near a point.
    virtual Vec3d velocity(const Vec3d& /*world*/, double /*time*/) const { return Vec3d::Zero(); }

    /// The farthest that any point of the surface moves from one time to the other; infinite where it has no end and
    /// turns.
    virtual double reach(double /*begin*/, double /*end*/) const { return 0.0; }
};

/// Makes an ImplicitField of a form that does not move, which has `double phi(p) const`, `Vec3d gradient(p) const`,
/// `Box box() const`, `double thinnestWall() const` and `static constexpr bool kConvex`.
template <class Form> class FormField final : public ImplicitField {
public:
    explicit FormField(const Form& form) : form_(form) {}

    double phi(const Vec3d& world, double) const override { return form_.phi(world); }
    FieldSample sample(const Vec3d& world, double) const override { return {form_.phi(world), form_.gradient(world)}; }
    void phiInRow(const Vec3d& from, const Vec3d& step, int count, double, double* out) const override
    {
        for (int i = 0; i < count; ++i) out[i] = form_.phi(from + double(i) * step);
    }
    Box box() const override { return form_.box(); }
    double thinnestWall() const override { return form_.thinnestWall(); }
    bool convex() const override { return Form::kConvex; }
    const Form& form() const { return form_; }

private:
    Form form_;
};

} // namespace vdbounce
