// SPDX-License-Identifier: Apache-2.0
//
// phi and gradient of several points at once. Rows of four voxels along z (vector_rows-inl.h) are added up with weights
// along x, then y, then z.
//
// No multiplication is fused with an addition, and each point's operations and their order are the same for any width:
// so all targets give the same bits.

// Included once for each target, as Highway has it, so no ordinary guard.
#if defined(VDBOUNCE_VECTOR_INTERPOLATION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VDBOUNCE_VECTOR_INTERPOLATION_INL_H
#undef VDBOUNCE_VECTOR_INTERPOLATION_INL_H
#else
#define VDBOUNCE_VECTOR_INTERPOLATION_INL_H
#endif

#include "vdbounce/field/vector_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vdbounce {
namespace HWY_NAMESPACE {

// Weights of the four values of a row, from the place z in the cell.
HWY_INLINE V linearWeights(const float (&constant)[4], const float (&slope)[4], V z)
{
    return hn::Add(everyPoint(constant), hn::Mul(everyPoint(slope), z));
}

// Those of linear interpolation between the two in the middle, and of the difference between them.
alignas(16) constexpr float kValue[2][4] = {{0.0f, 1.0f, 0.0f, 0.0f}, {0.0f, -1.0f, 1.0f, 0.0f}};
// Those of the interpolated central differences at the two in the middle.
alignas(16) constexpr float kCentral[2][4] = {{-0.5f, 0.0f, 0.5f, 0.0f}, {0.5f, -0.5f, -0.5f, 0.5f}};

// Each method returns (phi, gx, gy, gz) of kPointsPerVector points in stored units and index space, in the four lanes
// of each, from the addresses of their 4^3 values and the places in their cells.

// Lookup::Trilinear, Normal::Central: 12 rows (lecture, slide 28).
struct TrilinearCentral {
    template <class Values>
    static HWY_INLINE V interpolate(const Values& row, const float* x, const float* y, const float* z)
    {
        const Lanes d;
        const V one = hn::Set(d, 1.0f);
        const V x1 = ofEachPoint(x);
        const V y1 = ofEachPoint(y);
        const V z1 = ofEachPoint(z);
        const V x0 = hn::Sub(one, x1);
        const V y0 = hn::Sub(one, y1);
        V phi[4];   // along x, at the four places along y
        V twice[2]; // twice the central differences along x, at the two middle ones
        for (int j = 0; j < 4; ++j) {
            const V below = row.at(1, j);
            const V above = row.at(2, j);
            phi[j] = blend(below, above, x0, x1);
            if (j == 0 || j == 3) continue;
            twice[j - 1] = blend(hn::Sub(above, row.at(0, j)), hn::Sub(row.at(3, j), below), x0, x1);
        }
        const V value = blend(phi[1], phi[2], y0, y1);
        const V alongX = blend(twice[0], twice[1], y0, y1);
        const V alongY = blend(hn::Sub(phi[2], phi[0]), hn::Sub(phi[3], phi[1]), y0, y1);
        const V valueWeight = linearWeights(kValue[0], kValue[1], z1);
        const V halfWeight = hn::Mul(hn::Set(d, 0.5f), valueWeight);
        return sums(hn::Mul(value, valueWeight), hn::Mul(alongX, halfWeight), hn::Mul(alongY, halfWeight),
                    hn::Mul(value, linearWeights(kCentral[0], kCentral[1], z1)));
    }
};

// Lookup::Trilinear, Normal::Analytic: 4 rows.
struct TrilinearAnalytic {
    template <class Values>
    static HWY_INLINE V interpolate(const Values& row, const float* x, const float* y, const float* z)
    {
        const V one = hn::Set(Lanes(), 1.0f);
        const V x1 = ofEachPoint(x);
        const V y1 = ofEachPoint(y);
        const V x0 = hn::Sub(one, x1);
        const V y0 = hn::Sub(one, y1);
        V phi[2];
        V difference[2];
        for (int j = 0; j < 2; ++j) {
            const V below = row.at(1, j + 1);
            const V above = row.at(2, j + 1);
            phi[j] = blend(below, above, x0, x1);
            difference[j] = hn::Sub(above, below);
        }
        const V value = blend(phi[0], phi[1], y0, y1);
        const V weight = linearWeights(kValue[0], kValue[1], ofEachPoint(z));
        return sums(hn::Mul(value, weight), hn::Mul(blend(difference[0], difference[1], y0, y1), weight),
                    hn::Mul(hn::Sub(phi[1], phi[0]), weight), hn::Mul(value, everyPoint(kValue[1])));
    }
};

// Lookup::Nearest, Normal::Central: 5 rows; the cell is that above the nearest voxel.
struct NearestCentral {
    template <class Values> static HWY_INLINE V interpolate(const Values& row, const float*, const float*, const float*)
    {
        const V own = row.at(1, 1);
        const V value = everyPoint(kValue[0]);
        const V half = hn::Mul(hn::Set(Lanes(), 0.5f), value);
        return sums(hn::Mul(own, value), hn::Mul(hn::Sub(row.at(2, 1), row.at(0, 1)), half),
                    hn::Mul(hn::Sub(row.at(1, 2), row.at(1, 0)), half), hn::Mul(own, everyPoint(kCentral[0])));
    }
};

// Coefficients of the Catmull-Rom weights of four values in powers of the place between the middle two, and of their
// derivatives.
alignas(16) constexpr float kSpline[4][4] = {
    {0.0f, 1.0f, 0.0f, 0.0f}, {-0.5f, 0.0f, 0.5f, 0.0f}, {1.0f, -2.5f, 2.0f, -0.5f}, {-0.5f, 1.5f, -1.5f, 0.5f}};
alignas(16) constexpr float kSplineSlope[4][4] = {
    {-0.5f, 0.0f, 0.5f, 0.0f}, {2.0f, -5.0f, 4.0f, -1.0f}, {-1.5f, 4.5f, -4.5f, 1.5f}, {0.0f, 0.0f, 0.0f, 0.0f}};

// Weight `which` for all lanes of a point.
HWY_INLINE V splineWeight(const float (&coefficients)[4][4], int which, V t)
{
    const Lanes d;
    V weight = hn::Set(d, coefficients[3][which]);
    for (int power = 2; power >= 0; --power)
        weight = hn::Add(hn::Mul(weight, t), hn::Set(d, coefficients[power][which]));
    return weight;
}

// The four weights in the four lanes of a point.
HWY_INLINE V splineWeights(const float (&coefficients)[4][4], V t)
{
    V weights = everyPoint(coefficients[3]);
    for (int power = 2; power >= 0; --power) weights = hn::Add(hn::Mul(weights, t), everyPoint(coefficients[power]));
    return weights;
}

// Lookup::Cubic, Normal::Analytic: 16 rows.
struct CubicAnalytic {
    template <class Values>
    static HWY_INLINE V interpolate(const Values& row, const float* x, const float* y, const float* z)
    {
        const V x1 = ofEachPoint(x);
        const V y1 = ofEachPoint(y);
        const V z1 = ofEachPoint(z);
        V xWeight[4];
        V xSlope[4];
        for (int i = 0; i < 4; ++i) {
            xWeight[i] = splineWeight(kSpline, i, x1);
            xSlope[i] = splineWeight(kSplineSlope, i, x1);
        }
        V value = hn::Zero(Lanes());
        V alongX = value;
        V alongY = value;
        for (int j = 0; j < 4; ++j) {
            V phi = hn::Zero(Lanes());
            V slope = phi;
            for (int i = 0; i < 4; ++i) {
                const V four = row.at(i, j);
                phi = hn::Add(phi, hn::Mul(four, xWeight[i]));
                slope = hn::Add(slope, hn::Mul(four, xSlope[i]));
            }
            const V yWeight = splineWeight(kSpline, j, y1);
            value = hn::Add(value, hn::Mul(phi, yWeight));
            alongX = hn::Add(alongX, hn::Mul(slope, yWeight));
            alongY = hn::Add(alongY, hn::Mul(phi, splineWeight(kSplineSlope, j, y1)));
        }
        const V zWeights = splineWeights(kSpline, z1);
        return sums(hn::Mul(value, zWeights), hn::Mul(alongX, zWeights), hn::Mul(alongY, zWeights),
                    hn::Mul(value, splineWeights(kSplineSlope, z1)));
    }
};

// From stored units and index space to the world's.
HWY_INLINE V toWorld(const VectorField& field, V sample)
{
    V world = hn::Mul(hn::Broadcast<0>(sample), everyPoint(field.columns[0]));
    world = hn::Add(world, hn::Mul(hn::Broadcast<1>(sample), everyPoint(field.columns[1])));
    world = hn::Add(world, hn::Mul(hn::Broadcast<2>(sample), everyPoint(field.columns[2])));
    return hn::Add(world, hn::Mul(hn::Broadcast<3>(sample), everyPoint(field.columns[3])));
}

} // namespace HWY_NAMESPACE
} // namespace vdbounce
HWY_AFTER_NAMESPACE();

#endif
