// SPDX-License-Identifier: Apache-2.0

// See field/vector_lookup.cpp: the tests compare all targets.
#define HWY_BROKEN_EMU128 0

// The rest of this file is compiled once for each target, which needs this order.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vdbounce/implicit/cubic_feet.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "vdbounce/implicit/cubic_feet.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace vdbounce {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Span = hn::CappedTag<float, CubicFeet::kCount>;
using V = hn::Vec<Span>;

// Two steps do where the surface is far from the voxel's side of its bend; near where the ways to it meet, more.
constexpr int kNewtonSteps = 8;

// A voxel is done after a step shorter than this, voxels: what is left is its square.
constexpr float kDone = 2e-3f;

// Below this determinant of (metric + bend) the surface's bend is left out.
constexpr float kSmallestDeterminant = 1e-3f;

HWY_INLINE V set(float value) { return hn::Set(Span(), value); }
HWY_INLINE V sum(V a, V b, V c) { return hn::Add(hn::Add(a, b), c); }
HWY_INLINE V sum(V a, V b, V c, V d) { return hn::Add(hn::Add(a, b), hn::Add(c, d)); }
HWY_INLINE V dot(const V (&a)[3], const V (&b)[3])
{
    return sum(hn::Mul(a[0], b[0]), hn::Mul(a[1], b[1]), hn::Mul(a[2], b[2]));
}

struct Taylor {
    V value;
    V gradient[3];
    V second[6]; // xx, yy, zz, xy, xz, yz

    // The terms as in Cubic.
    HWY_INLINE Taylor(const V (&c)[Cubic::kTerms], V x, V y, V z)
    {
        const auto times = [](V a, V b) { return hn::Mul(a, b); };
        const V two = set(2.0f);
        const V three = set(3.0f);
        const V xx = sum(c[4], times(c[13], y), times(c[14], z)); // without x^3
        const V yy = sum(c[5], times(c[15], x), times(c[16], z));
        const V zz = sum(c[6], times(c[17], x), times(c[18], y));
        const V x3 = times(c[10], x);
        const V y3 = times(c[11], y);
        const V z3 = times(c[12], z);
        second[0] = times(two, hn::Add(xx, times(three, x3)));
        second[1] = times(two, hn::Add(yy, times(three, y3)));
        second[2] = times(two, hn::Add(zz, times(three, z3)));
        second[3] = sum(c[7], times(two, hn::Add(times(c[13], x), times(c[15], y))), times(c[19], z));
        second[4] = sum(c[8], times(two, hn::Add(times(c[14], x), times(c[17], z))), times(c[19], y));
        second[5] = sum(c[9], times(two, hn::Add(times(c[16], y), times(c[18], z))), times(c[19], x));
        gradient[0] =
            sum(c[1], times(x, hn::Add(times(two, xx), times(three, x3))), times(y, hn::Add(c[7], times(c[15], y))),
                times(z, sum(c[8], times(c[17], z), times(c[19], y))));
        gradient[1] =
            sum(c[2], times(y, hn::Add(times(two, yy), times(three, y3))), times(x, hn::Add(c[7], times(c[13], x))),
                times(z, sum(c[9], times(c[18], z), times(c[19], x))));
        gradient[2] =
            sum(c[3], times(z, hn::Add(times(two, zz), times(three, z3))), times(x, hn::Add(c[8], times(c[14], x))),
                times(y, sum(c[9], times(c[16], y), times(c[19], x))));
        value = sum(c[0], times(x, hn::Add(c[1], times(x, hn::Add(x3, xx)))),
                    times(y, sum(c[2], times(c[7], x), times(y, sum(c[5], y3, times(c[16], z), times(c[15], x))))),
                    times(z, hn::Add(sum(c[3], times(c[8], x), times(c[9], y), times(c[19], times(x, y))),
                                     times(z, sum(c[6], z3, times(c[17], x), times(c[18], y))))));
    }
};

// The adjugate of a symmetric matrix and its determinant.
struct Adjugate {
    V a[6];
    V determinant;

    HWY_INLINE explicit Adjugate(const V (&m)[6])
    {
        const auto minor = [&](int i, int j, int k, int l) {
            return hn::Sub(hn::Mul(m[i], m[j]), hn::Mul(m[k], m[l]));
        };
        a[0] = minor(1, 2, 5, 5);
        a[1] = minor(0, 2, 4, 4);
        a[2] = minor(0, 1, 3, 3);
        a[3] = minor(4, 5, 3, 2);
        a[4] = minor(3, 5, 4, 1);
        a[5] = minor(3, 4, 5, 0);
        determinant = sum(hn::Mul(m[0], a[0]), hn::Mul(m[3], a[3]), hn::Mul(m[4], a[4]));
    }
};

HWY_INLINE void apply(const V (&m)[6], const V (&v)[3], V (&result)[3])
{
    result[0] = sum(hn::Mul(m[0], v[0]), hn::Mul(m[3], v[1]), hn::Mul(m[4], v[2]));
    result[1] = sum(hn::Mul(m[3], v[0]), hn::Mul(m[1], v[1]), hn::Mul(m[5], v[2]));
    result[2] = sum(hn::Mul(m[4], v[0]), hn::Mul(m[5], v[1]), hn::Mul(m[2], v[2]));
}

// One step; returns its largest component.
HWY_INLINE V newtonStep(const V (&cubic)[Cubic::kTerms], const V (&metric)[6], const V (&voxel)[3], V (&foot)[3])
{
    const Taylor at(cubic, foot[0], foot[1], foot[2]);
    const V way[3] = {hn::Sub(voxel[0], foot[0]), hn::Sub(voxel[1], foot[1]), hn::Sub(voxel[2], foot[2])};
    V mapped[3];
    apply(metric, way, mapped);
    const V lambda = hn::Div(dot(at.gradient, mapped), dot(at.gradient, at.gradient));
    V bent[6];
    for (int i = 0; i < 6; ++i) bent[i] = hn::Add(metric[i], hn::Mul(lambda, at.second[i]));
    Adjugate inverse(bent);
    const auto usable = hn::Gt(inverse.determinant, set(kSmallestDeterminant));
    const Adjugate flat(metric);
    for (int i = 0; i < 6; ++i) inverse.a[i] = hn::IfThenElse(usable, inverse.a[i], flat.a[i]);
    inverse.determinant = hn::IfThenElse(usable, inverse.determinant, flat.determinant);
    V alongGradient[3];
    V alongWay[3];
    apply(inverse.a, at.gradient, alongGradient);
    apply(inverse.a, mapped, alongWay);
    const V mu = hn::Div(hn::Add(dot(at.gradient, alongWay), hn::Mul(at.value, inverse.determinant)),
                         dot(at.gradient, alongGradient));
    const V scale = hn::Div(set(1.0f), inverse.determinant);
    V length = hn::Zero(Span());
    for (int a = 0; a < 3; ++a) {
        const V step = hn::Mul(hn::Sub(alongWay[a], hn::Mul(mu, alongGradient[a])), scale);
        length = hn::Max(length, hn::Abs(step));
        foot[a] = hn::Add(foot[a], step);
    }
    return length;
}

void findFeet(CubicFeet& feet, const VoxelMetric& voxels)
{
    const Span d;
    V metric[6];
    for (int i = 0; i < 6; ++i) metric[i] = set(voxels.g[i]);
    for (int i = 0; i < CubicFeet::kCount; i += int(hn::Lanes(d))) {
        V cubic[Cubic::kTerms];
        for (int t = 0; t < Cubic::kTerms; ++t) cubic[t] = hn::Load(d, feet.cubic[t] + i);
        V voxel[3];
        V foot[3];
        for (int a = 0; a < 3; ++a) {
            voxel[a] = hn::Load(d, feet.voxel[a] + i);
            foot[a] = hn::Load(d, feet.foot[a] + i);
        }
        // Each lane stops by itself, so that its bits do not depend on those beside it.
        V step = set(1.0f);
        auto going = hn::Gt(step, hn::Zero(d));
        for (int n = 0; n < kNewtonSteps && !hn::AllFalse(d, going); ++n) {
            V next[3] = {foot[0], foot[1], foot[2]};
            const V length = newtonStep(cubic, metric, voxel, next);
            for (int a = 0; a < 3; ++a) foot[a] = hn::IfThenElse(going, next[a], foot[a]);
            step = hn::IfThenElse(going, length, step);
            going = hn::And(going, hn::Gt(length, set(kDone)));
        }
        const V way[3] = {hn::Sub(foot[0], voxel[0]), hn::Sub(foot[1], voxel[1]), hn::Sub(foot[2], voxel[2])};
        V mapped[3];
        apply(metric, way, mapped);
        for (int a = 0; a < 3; ++a) hn::Store(foot[a], d, feet.foot[a] + i);
        hn::Store(step, d, feet.step + i);
        hn::Store(dot(way, mapped), d, feet.squared + i);
    }
}

} // namespace HWY_NAMESPACE
} // namespace vdbounce
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vdbounce {

HWY_EXPORT(findFeet);

void findCubicFeet(CubicFeet& feet, const VoxelMetric& metric) { HWY_DYNAMIC_DISPATCH(findFeet)(feet, metric); }

} // namespace vdbounce
#endif
