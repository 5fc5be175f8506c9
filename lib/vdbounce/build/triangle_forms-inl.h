// SPDX-License-Identifier: Apache-2.0
//
// Triangles as linear functions of a leaf's voxels; part of nearest_in_leaf.cpp, compiled for each target.

#if defined(VDBOUNCE_TRIANGLE_FORMS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VDBOUNCE_TRIANGLE_FORMS_INL_H
#undef VDBOUNCE_TRIANGLE_FORMS_INL_H
#else
#define VDBOUNCE_TRIANGLE_FORMS_INL_H
#endif

#include "vdbounce/build/nearest_in_leaf.h"

#include <cmath>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vdbounce {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// What the search needs of up to eight triangles, each function's values side by side. In each triangle's own frame the
// longest edge runs from a to b along e, c lies at height t above it along v, and n = e x v.
//   0      height above the plane
//   1..3   distance across each edge, positive outside: ab, bc, ca
//   4..6   distance before each edge's start, positive there; "minusLength" less this is how far it is past its end
struct TriangleForms {
    static constexpr int kLanes = 8;
    static constexpr int kForms = 7;

    alignas(64) float constant[kForms][kLanes];
    alignas(64) float gradient[kForms][3][kLanes]; // a voxel along x, y, z
    alignas(64) float minusLength[3][kLanes];
    alignas(64) int low[2][kLanes]; // of the voxels within reach, along x and y
    alignas(64) int high[2][kLanes];
};

using Doubles = hn::CappedTag<double, TriangleForms::kLanes>;
using D = hn::Vec<Doubles>;

struct Vector {
    D x, y, z;

    Vector operator-(const Vector& o) const { return {hn::Sub(x, o.x), hn::Sub(y, o.y), hn::Sub(z, o.z)}; }
    Vector operator*(D s) const { return {hn::Mul(x, s), hn::Mul(y, s), hn::Mul(z, s)}; }
    D dot(const Vector& o) const { return hn::Add(hn::Add(hn::Mul(x, o.x), hn::Mul(y, o.y)), hn::Mul(z, o.z)); }
    Vector cross(const Vector& o) const
    {
        return {hn::Sub(hn::Mul(y, o.z), hn::Mul(z, o.y)), hn::Sub(hn::Mul(z, o.x), hn::Mul(x, o.z)),
                hn::Sub(hn::Mul(x, o.y), hn::Mul(y, o.x))};
    }
};

HWY_INLINE Vector choose(hn::Mask<Doubles> mask, const Vector& yes, const Vector& no)
{
    return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y), hn::IfThenElse(mask, yes.z, no.z)};
}

// v over its length; `otherwise` where it has none.
HWY_INLINE Vector unit(const Vector& v, D length, const Vector& otherwise)
{
    const Doubles d;
    return choose(hn::Gt(length, hn::Zero(d)), v * hn::Div(hn::Set(d, 1.0), length), otherwise);
}

// Any unit vector perpendicular to the unit vector e.
HWY_INLINE Vector perpendicular(const Vector& e)
{
    const Doubles d;
    const auto zero = hn::Zero(d);
    // Crossed with the axis that e has least of.
    const auto ax = hn::Abs(e.x);
    const auto ay = hn::Abs(e.y);
    const auto az = hn::Abs(e.z);
    const auto useX = hn::And(hn::Le(ax, ay), hn::Le(ax, az));
    const Vector byX{zero, e.z, hn::Neg(e.y)};
    const Vector byOther = choose(hn::Le(ay, az), {hn::Neg(e.z), zero, e.x}, {e.y, hn::Neg(e.x), zero});
    const Vector v = choose(useX, byX, byOther);
    return v * hn::Div(hn::Set(d, 1.0), hn::Sqrt(v.dot(v)));
}

// The corners relative to the leaf's origin, so turned that the longest edge comes first.
struct Corners {
    Vector a, b, c;

    HWY_INLINE explicit Corners(const double (&at)[9][TriangleForms::kLanes], int first)
    {
        const Doubles d;
        const auto load = [&](int which) {
            return Vector{hn::Load(d, at[which] + first), hn::Load(d, at[which + 1] + first),
                          hn::Load(d, at[which + 2] + first)};
        };
        const Vector p = load(0);
        const Vector q = load(3);
        const Vector r = load(6);
        const D pq = (q - p).dot(q - p);
        const D qr = (r - q).dot(r - q);
        const D rp = (p - r).dot(p - r);
        const auto pqLongest = hn::And(hn::Ge(pq, qr), hn::Ge(pq, rp));
        const auto qrLongest = hn::Ge(qr, rp);
        a = choose(pqLongest, p, choose(qrLongest, q, r));
        b = choose(pqLongest, q, choose(qrLongest, r, p));
        c = choose(pqLongest, r, choose(qrLongest, p, q));
    }
};

HWY_INLINE void storeFloats(D values, float* to)
{
    const hn::Rebind<float, Doubles> df;
    hn::StoreU(hn::DemoteTo(df, values), df, to);
}

// direction . (voxel - through) as a function of the voxel's offset.
HWY_INLINE void storeForm(TriangleForms& forms, int number, int first, const LeafPlace& place, const Vector& direction,
                          const Vector& through)
{
    const Doubles d;
    storeFloats(hn::Neg(direction.dot(through)), forms.constant[number] + first);
    for (int axis = 0; axis < 3; ++axis) {
        const auto column = place.indexToWorld.col(axis);
        const Vector step{hn::Set(d, column.x()), hn::Set(d, column.y()), hn::Set(d, column.z())};
        storeFloats(direction.dot(step), forms.gradient[number][axis] + first);
    }
}

// How far an edge's start is along its direction and how long it is, of the part of it that is no farther from the leaf
// than any point that matters: the ends of a long edge would take all the digits that a float has.
HWY_INLINE void storeEnds(TriangleForms& forms, int edge, int first, const LeafPlace& place, const Vector& direction,
                          const Vector& start, D length)
{
    const Doubles d;
    const int number = 4 + edge;
    storeForm(forms, number, first, place, {hn::Neg(direction.x), hn::Neg(direction.y), hn::Neg(direction.z)}, start);
    const double farthest = place.reach + 7.0 * place.indexToWorld.colwise().norm().sum();
    const D low = hn::Set(d, -farthest);
    const D high = hn::Set(d, farthest);
    const D from = direction.dot(start);
    const D nearFrom = hn::Min(hn::Max(from, low), high);
    const D nearTo = hn::Min(hn::Max(hn::Add(from, length), low), high);
    storeFloats(nearFrom, forms.constant[number] + first);
    storeFloats(hn::Sub(nearFrom, nearTo), forms.minusLength[edge] + first);
}

HWY_INLINE void storeReach(TriangleForms& forms, int axis, int first, const LeafPlace& place, const Corners& corners)
{
    const Doubles d;
    const auto row = place.worldToIndex.row(axis);
    const Vector toIndex{hn::Set(d, row.x()), hn::Set(d, row.y()), hn::Set(d, row.z())};
    const D reach = hn::Set(d, place.reach * row.norm());
    const D a = toIndex.dot(corners.a);
    const D b = toIndex.dot(corners.b);
    const D c = toIndex.dot(corners.c);
    // Clamped before they become whole numbers, since a large triangle is far beyond any.
    const D low = hn::Ceil(hn::Sub(hn::Min(hn::Min(a, b), c), reach));
    const D high = hn::Floor(hn::Add(hn::Max(hn::Max(a, b), c), reach));
    const hn::Rebind<std::int32_t, Doubles> di;
    const D zero = hn::Zero(d);
    const D eight = hn::Set(d, 8.0);
    hn::StoreU(hn::DemoteTo(di, hn::Min(hn::Max(low, zero), eight)), di, forms.low[axis] + first);
    hn::StoreU(hn::DemoteTo(di, hn::Min(hn::Max(high, hn::Set(d, -1.0)), hn::Set(d, 7.0))), di,
               forms.high[axis] + first);
}

// A triangle lower than this part of its longest edge is that edge: rounding turns it around the edge, so that it is
// off by no more than this part of its length.
constexpr double kFlat = 1e-13;

HWY_INLINE void makeFormsOf(const double (&at)[9][TriangleForms::kLanes], int first, const LeafPlace& place,
                            TriangleForms& forms)
{
    const Doubles d;
    const auto zero = hn::Zero(d);
    const Corners corners(at, first);
    const Vector& a = corners.a;
    const Vector ab = corners.b - a;
    const D length = hn::Sqrt(ab.dot(ab));
    const Vector e = unit(ab, length, {hn::Set(d, 1.0), zero, zero});
    const Vector ac = corners.c - a;
    const D s = ac.dot(e);
    const Vector roughlyUp = ac - e * s;
    const Vector up = roughlyUp - e * roughlyUp.dot(e); // once more, for where it is much shorter than ac
    D t = hn::Sqrt(up.dot(up));
    // Without height it is its longest edge alone.
    t = hn::IfThenElseZero(hn::Gt(t, hn::Mul(hn::Set(d, kFlat), length)), t);
    const Vector v = unit(up, t, perpendicular(e));
    const Vector n = e.cross(v);

    // From b to c, and from c to a, in the plane's frame (e, v).
    const D rest = hn::Sub(length, s);
    const D lengthBc = hn::Sqrt(hn::Add(hn::Mul(rest, rest), hn::Mul(t, t)));
    const D lengthCa = hn::Sqrt(hn::Add(hn::Mul(s, s), hn::Mul(t, t)));
    const auto inFrame = [&](D alongE, D alongV, D size, const Vector& otherwise) {
        const Vector direction{hn::Add(hn::Mul(e.x, alongE), hn::Mul(v.x, alongV)),
                               hn::Add(hn::Mul(e.y, alongE), hn::Mul(v.y, alongV)),
                               hn::Add(hn::Mul(e.z, alongE), hn::Mul(v.z, alongV))};
        return unit(direction, size, otherwise);
    };
    storeForm(forms, 0, first, place, n, a);
    storeForm(forms, 1, first, place, {hn::Neg(v.x), hn::Neg(v.y), hn::Neg(v.z)}, a);
    storeForm(forms, 2, first, place, inFrame(t, rest, lengthBc, v), corners.b);
    storeForm(forms, 3, first, place, inFrame(hn::Neg(t), s, lengthCa, v), a);
    storeEnds(forms, 0, first, place, e, a, length);
    storeEnds(forms, 1, first, place, inFrame(hn::Neg(rest), t, lengthBc, e), corners.b, lengthBc);
    storeEnds(forms, 2, first, place, inFrame(hn::Neg(s), hn::Neg(t), lengthCa, e), corners.c, lengthCa);
    storeReach(forms, 0, first, place, corners);
    storeReach(forms, 1, first, place, corners);
}

HWY_INLINE void makeForms(const TriangleMesh& mesh, const std::uint32_t* list, std::size_t count,
                          const LeafPlace& place, TriangleForms& forms)
{
    alignas(64) double at[9][TriangleForms::kLanes];
    for (std::size_t i = 0; i < std::size_t(TriangleForms::kLanes); ++i) {
        const auto& triangle = mesh.triangles[list[i < count ? i : 0]];
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const Vec3d& point = mesh.points[triangle[corner]];
            for (int axis = 0; axis < 3; ++axis) {
                at[3 * corner + std::size_t(axis)][i] = point[axis] - place.origin[axis];
            }
        }
    }
    for (int first = 0; first < TriangleForms::kLanes; first += int(hn::Lanes(Doubles())))
        makeFormsOf(at, first, place, forms);
}

} // namespace HWY_NAMESPACE
} // namespace vdbounce
HWY_AFTER_NAMESPACE();

#endif
