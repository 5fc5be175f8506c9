// SPDX-License-Identifier: Apache-2.0
//
// A Gaussian is a product of one along each axis, and the compact kernel the cube of a sum of one along each axis: so a
// ball takes 24 values, and then a product or a sum for each row of eight voxels.

// See field/vector_lookup.cpp: the tests compare all targets.
#define HWY_BROKEN_EMU128 0

// The rest of this file is compiled once for each target, which needs this order.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vdbounce/implicit/kernel_leaf.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "vdbounce/implicit/float_math-inl.h"
#include "vdbounce/implicit/kernel_leaf.h"
#include "vdbounce/implicit/leaf_rows-inl.h"
// clang-format on

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace vdbounce {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::Vec<RowFloats>;

// Beyond this e^-x counts for nothing at any cut-off, and products of two are no denormal numbers.
constexpr float kLargestArgument = 40.0f;

// Bounds are taken apart by this part of themselves, more than what rounding takes.
constexpr float kBoundMargin = 1e-4f;

// Sums are at least this, for their logarithm.
constexpr float kLeastSum = 1e-30f;

// Squared distances over the squared radius, along each axis.
struct Arguments {
    alignas(64) float axis[3][8];

    template <class Offsets> HWY_INLINE Arguments(const Ball& ball, const Offsets& at)
    {
        const RowDoubles d;
        const hn::Rebind<float, RowDoubles> df;
        const auto scale = hn::Set(d, 1.0 / (ball.radius * ball.radius));
        for (int a = 0; a < 3; ++a) {
            for (std::size_t i = 0; i < 8; i += hn::Lanes(d))
                hn::Store(hn::DemoteTo(df, hn::Mul(hn::Load(d, at.squared[a] + i), scale)), df, axis[a] + i);
        }
    }
};

HWY_INLINE void addGaussian(const Arguments& at, float least, float* values)
{
    const RowFloats d;
    alignas(64) float factors[3][8];
    for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < 8; i += hn::Lanes(d)) {
            const F x = hn::Min(hn::Load(d, at.axis[axis] + i), hn::Set(d, kLargestArgument));
            hn::Store(exponential(d, hn::Neg(x)), d, factors[axis] + i);
        }
    }
    alignas(64) float rows[64]; // negative, so that those that matter are below
    for (std::size_t y = 0; y < 8; y += hn::Lanes(d)) {
        const F along = hn::Neg(hn::Load(d, factors[1] + y));
        for (std::size_t x = 0; x < 8; ++x) hn::Store(hn::Mul(hn::Set(d, factors[0][x]), along), d, rows + 8 * x + y);
    }
    const float most = *std::max_element(factors[2], factors[2] + 8);
    const F smallest = hn::Set(d, least);
    for (std::uint64_t bits = rowsBelow(rows, -least * (1.0f - kBoundMargin) / most); bits != 0; bits &= bits - 1) {
        const auto row = std::size_t(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
        const F along = hn::Set(d, -rows[row]);
        for (std::size_t z = 0; z < 8; z += hn::Lanes(d)) {
            const F value = hn::Mul(along, hn::Load(d, factors[2] + z));
            float* to = values + 8 * row + z;
            hn::StoreU(hn::Add(hn::LoadU(d, to), hn::IfThenElseZero(hn::Ge(value, smallest), value)), d, to);
        }
    }
}

HWY_INLINE F cubeOf(F u) { return hn::Mul(hn::Mul(u, u), u); }

HWY_INLINE void addCompact(const Arguments& at, float least, float* values)
{
    const RowFloats d;
    alignas(64) float rows[64]; // of x^2
    sumRows(at.axis[0], at.axis[1], rows);
    const F smallest = hn::Set(d, least);
    const F one = hn::Set(d, 1.0f);
    const F quarter = hn::Set(d, 0.25f);
    for (std::uint64_t bits = rowsBelow(rows, 4.0f - *std::min_element(at.axis[2], at.axis[2] + 8)); bits != 0;
         bits &= bits - 1) {
        const auto row = std::size_t(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
        const F along = hn::Set(d, rows[row]);
        for (std::size_t z = 0; z < 8; z += hn::Lanes(d)) {
            const F squared = hn::Add(along, hn::Load(d, at.axis[2] + z));
            const F value = cubeOf(hn::Max(hn::Sub(one, hn::Mul(quarter, squared)), hn::Zero(d)));
            float* to = values + 8 * row + z;
            hn::StoreU(hn::Add(hn::LoadU(d, to), hn::IfThenElseZero(hn::Ge(value, smallest), value)), d, to);
        }
    }
}

HWY_INLINE void addKernel(BlobKernel kernel, const Arguments& at, float least, float* values)
{
    if (kernel == BlobKernel::Gaussian) {
        addGaussian(at, least, values);
    } else {
        addCompact(at, least, values);
    }
}

HWY_INLINE float leastOf(const float* values)
{
    const RowFloats d;
    F least = hn::Load(d, values);
    for (std::size_t i = 0; i < 512; i += hn::Lanes(d)) least = hn::Min(least, hn::Load(d, values + i));
    return hn::GetLane(hn::MinOfLanes(d, least));
}

void sumLeaf(const Ball* balls, std::size_t count, const Vec3i& leaf, const KernelSum& sum, float* values)
{
    std::fill_n(values, 512, 0.0f);
    const Vec3d origin = 8.0 * leaf.cast<double>();
    for (std::size_t i = 0; i < count; ++i) {
        const Arguments at(balls[i], LeafOffsets(balls[i], origin));
        addKernel(sum.kernel, at, sum.least, values);
    }
}

// The squared distances from a ball's centre to the far ends of the 8 cells of a box, axis by axis.
struct FarOffsets {
    alignas(64) double squared[3][8];

    HWY_INLINE FarOffsets(const Ball& ball, const Box& box)
    {
        const double centre[3] = {ball.x, ball.y, ball.z};
        for (int axis = 0; axis < 3; ++axis) {
            const double half = (box.max[axis] - box.min[axis]) / 16.0;
            for (int i = 0; i < 8; ++i) {
                const double middle = box.min[axis] + (2 * i + 1) * half;
                const double far = std::abs(middle - centre[axis]) + half;
                squared[axis][i] = far * far;
            }
        }
    }
};

bool coverBox(const Ball* balls, std::size_t count, const Box& box, const KernelSum& sum, float level)
{
    constexpr std::size_t kBallsPerLook = 16;
    alignas(64) float low[512] = {};
    const float least = sum.least * (1.0f + kBoundMargin);
    const float enough = level * (1.0f + kBoundMargin);
    for (std::size_t begin = 0; begin < count; begin += kBallsPerLook) {
        for (std::size_t i = begin; i < std::min(count, begin + kBallsPerLook); ++i)
            addKernel(sum.kernel, Arguments(balls[i], FarOffsets(balls[i], box)), least, low);
        if (leastOf(low) > enough) return true;
    }
    return false;
}

// The kernel of squared arguments.
HWY_INLINE F kernelOf(BlobKernel kernel, F squared)
{
    const RowFloats d;
    if (kernel == BlobKernel::Gaussian) return exponential(d, hn::Neg(hn::Min(squared, hn::Set(d, kLargestArgument))));
    return cubeOf(hn::Max(hn::Sub(hn::Set(d, 1.0f), hn::Mul(hn::Set(d, 0.25f), squared)), hn::Zero(d)));
}

// Nearest and farthest squared arguments of eight balls, the last repeated where there are fewer.
HWY_INLINE void argumentsToBox(const Ball* balls, std::size_t count, const Box& box, float (&near)[8], float (&far)[8])
{
    for (std::size_t i = 0; i < 8; ++i) {
        const Ball& ball = balls[std::min(i, count - 1)];
        const double centre[3] = {ball.x, ball.y, ball.z};
        double nearest = 0.0;
        double farthest = 0.0;
        for (int a = 0; a < 3; ++a) {
            const double below = box.min[a] - centre[a];
            const double above = centre[a] - box.max[a];
            const double apart = std::max(std::max(below, above), 0.0);
            const double across = std::min(below, above); // negative: minus the way to the far side
            nearest += apart * apart;
            farthest += across * across;
        }
        const double scale = 1.0 / (ball.radius * ball.radius);
        near[i] = float(std::min(nearest * scale, 1e6));
        far[i] = float(std::min(farthest * scale, 1e6));
    }
}

SumBounds boundSum(const Ball* balls, std::size_t count, const Box& box, const KernelSum& sum)
{
    const RowFloats d;
    const F smallest = hn::Set(d, sum.least * (1.0f + kBoundMargin));
    SumBounds bounds;
    for (std::size_t i = 0; i < count; i += 8) {
        alignas(64) float near[8];
        alignas(64) float far[8];
        argumentsToBox(balls + i, count - i, box, near, far);
        for (std::size_t k = 0; k < 8; k += hn::Lanes(d)) {
            hn::Store(kernelOf(sum.kernel, hn::Load(d, near + k)), d, near + k);
            const F low = kernelOf(sum.kernel, hn::Load(d, far + k));
            hn::Store(hn::IfThenElseZero(hn::Ge(low, smallest), low), d, far + k);
        }
        // One by one, so that the sum does not depend on the width of vectors.
        for (std::size_t k = 0; k < 8 && i + k < count; ++k) {
            bounds.high += near[k];
            bounds.low += far[k];
        }
    }
    bounds.low *= 1.0f - kBoundMargin;
    bounds.high *= 1.0f + kBoundMargin;
    return bounds;
}

void toArguments(BlobKernel kernel, float innermost, float* values)
{
    const RowFloats d;
    const bool gaussian = kernel == BlobKernel::Gaussian;
    // x = scale sqrt(w), and straight below w = least.
    const float scale = gaussian ? 1.0f : 2.0f;
    const F least = hn::Set(d, innermost * innermost / (scale * scale));
    const F edge = hn::Set(d, innermost);
    const F slope = hn::Set(d, 0.5f * scale * scale / innermost);
    for (std::size_t i = 0; i < 512; i += hn::Lanes(d)) {
        const F logOfSum = logarithm(d, hn::Max(hn::LoadU(d, values + i), hn::Set(d, kLeastSum)));
        const F w = gaussian ? hn::Neg(logOfSum)
                             : hn::Sub(hn::Set(d, 1.0f), exponential(d, hn::Mul(logOfSum, hn::Set(d, 1.0f / 3.0f))));
        const F curved = hn::Mul(hn::Set(d, scale), hn::Sqrt(hn::Max(w, least)));
        const F straight = hn::Add(edge, hn::Mul(hn::Sub(w, least), slope));
        hn::StoreU(hn::IfThenElse(hn::Lt(w, least), straight, curved), d, values + i);
    }
}

} // namespace HWY_NAMESPACE
} // namespace vdbounce
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vdbounce {

HWY_EXPORT(sumLeaf);
HWY_EXPORT(boundSum);
HWY_EXPORT(coverBox);
HWY_EXPORT(toArguments);

void sumKernelsInLeaf(const Ball* balls, std::size_t count, const Vec3i& leaf, const KernelSum& sum, float* values)
{
    HWY_DYNAMIC_DISPATCH(sumLeaf)(balls, count, leaf, sum, values);
}

SumBounds boundKernels(const Ball* balls, std::size_t count, const Box& box, const KernelSum& sum)
{
    return HWY_DYNAMIC_DISPATCH(boundSum)(balls, count, box, sum);
}

bool isCovered(const Ball* balls, std::size_t count, const Box& box, const KernelSum& sum, float level)
{
    return HWY_DYNAMIC_DISPATCH(coverBox)(balls, count, box, sum, level);
}

void sumsToArguments(BlobKernel kernel, float innermost, float* values)
{
    HWY_DYNAMIC_DISPATCH(toArguments)(kernel, innermost, values);
}

} // namespace vdbounce
#endif
