// SPDX-License-Identifier: Apache-2.0
//
// Balls are laid over the leaf one by one. What is asked of a ball at a voxel is the sum of a value for the row of
// eight voxels along z and one for the place in the row, so that rows are whole vectors and need an addition each.

// See field/vector_lookup.cpp: the tests compare all targets.
#define HWY_BROKEN_EMU128 0

// The rest of this file is compiled once for each target, which needs this order.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vdbounce/implicit/sphere_leaf.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "vdbounce/implicit/leaf_rows-inl.h"
#include "vdbounce/implicit/sphere_leaf.h"
// clang-format on

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace vdbounce {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Balls larger than this, voxels, are measured by how far beyond their surface a voxel is, whose rounding does not grow
// with the radius.
constexpr double kLargeRadius = 16.0;

// What the search in floats is off by at most, and more: voxels, and a part of the band.
constexpr double kSearchError = 1e-5;
constexpr double kSearchErrorOfBand = 1e-6;

struct Search {
    alignas(64) float distance[512]; // voxels
    alignas(64) std::int32_t ball[512];
};

// Squared distances of equal balls, least of all.
HWY_INLINE void searchEqual(const Ball* balls, std::size_t count, const Vec3d& origin, double reach, double* squared)
{
    const RowDoubles d;
    const double limit = reach * reach;
    std::fill_n(squared, 512, limit);
    for (std::size_t i = 0; i < count; ++i) {
        const LeafOffsets at(balls[i], origin);
        alignas(64) double rows[64];
        sumRows(at.squared[0], at.squared[1], rows);
        const double least = *std::min_element(at.squared[2], at.squared[2] + 8);
        for (std::uint64_t bits = rowsBelow(rows, limit - least); bits != 0; bits &= bits - 1) {
            const auto row = std::size_t(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
            const auto along = hn::Set(d, rows[row]);
            for (std::size_t z = 0; z < 8; z += hn::Lanes(d)) {
                double* best = squared + 8 * row + z;
                hn::Store(hn::Min(hn::Load(d, best), hn::Add(along, hn::Load(d, at.squared[2] + z))), d, best);
            }
        }
    }
}

// The distance of a row's voxels to a small ball: from squared distances to the centre.
struct SmallBall {
    explicit SmallBall(const Ball& ball) : radius(float(ball.radius)) {}
    hn::Vec<RowFloats> operator()(hn::Vec<RowFloats> squared) const
    {
        return hn::Sub(hn::Sqrt(squared), hn::Set(RowFloats(), radius));
    }
    float radius;
};

// To a large one: from q = d^2 - r^2, which is made in double, d - r = q / (d + r).
struct LargeBall {
    explicit LargeBall(const Ball& ball) : radius(float(ball.radius)), squaredRadius(float(ball.radius * ball.radius))
    {
    }
    hn::Vec<RowFloats> operator()(hn::Vec<RowFloats> q) const
    {
        const RowFloats d;
        const auto squared = hn::Max(hn::Add(q, hn::Set(d, squaredRadius)), hn::Zero(d));
        return hn::Div(q, hn::Add(hn::Sqrt(squared), hn::Set(d, radius)));
    }
    float radius;
    float squaredRadius;
};

// Where the rows of a ball are nearer than `limit`, given in what the rows hold, asks `distance`.
template <class Distance>
HWY_INLINE void layOver(const float (&rows)[64], const float (&alongZ)[8], double limit, const Distance& distance,
                        std::int32_t number, Search& search)
{
    const RowFloats d;
    const hn::RebindToSigned<RowFloats> di;
    const float least = *std::min_element(alongZ, alongZ + 8);
    for (std::uint64_t bits = rowsBelow(rows, float(limit) - least); bits != 0; bits &= bits - 1) {
        const auto row = std::size_t(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
        for (std::size_t z = 0; z < 8; z += hn::Lanes(d)) {
            const std::size_t at = 8 * row + z;
            const auto here = distance(hn::Add(hn::Set(d, rows[row]), hn::Load(d, alongZ + z)));
            const auto best = hn::Load(d, search.distance + at);
            const auto nearer = hn::RebindMask(di, hn::Lt(here, best));
            hn::Store(hn::Min(here, best), d, search.distance + at);
            hn::Store(hn::IfThenElse(nearer, hn::Set(di, number), hn::Load(di, search.ball + at)), di,
                      search.ball + at);
        }
    }
}

HWY_INLINE void searchSmall(const Ball& ball, std::int32_t number, const Vec3d& origin, double band, Search& search)
{
    const LeafOffsets at(ball, origin);
    alignas(64) float axis[3][8];
    for (int a = 0; a < 3; ++a) toFloats(at.squared[a], axis[a]);
    alignas(64) float rows[64];
    sumRows(axis[0], axis[1], rows);
    const double reach = ball.radius + band;
    layOver(rows, axis[2], reach * reach, SmallBall(ball), number, search);
}

HWY_INLINE void searchLarge(const Ball& ball, std::int32_t number, const Vec3d& origin, double band, Search& search)
{
    // From the leaf's centre p^2 - 2 p.c + (c^2 - r^2), with the last part to the one along x.
    const Vec3d centre = Vec3d(ball.x, ball.y, ball.z) - origin - Vec3d::Constant(3.5);
    const double far = centre.norm();
    alignas(64) float axis[3][8];
    for (int a = 0; a < 3; ++a) {
        const double first = a == 0 ? (far - ball.radius) * (far + ball.radius) : 0.0;
        for (int i = 0; i < 8; ++i) {
            const double p = i - 3.5;
            axis[a][i] = float(first + p * (p - 2.0 * centre[a]));
        }
    }
    alignas(64) float rows[64];
    sumRows(axis[0], axis[1], rows);
    layOver(rows, axis[2], band * (band + 2.0 * ball.radius), LargeBall(ball), number, search);
}

// Voxels within the band are active, all others become its width.
HWY_INLINE void cutToBand(const SphereBand& band, SphereLeaf& result)
{
    const RowFloats d;
    // Rounded as phi is, not up, or voxels just as far as the band is wide would be within.
    const auto limit = hn::Set(d, float(band.halfWidthVx * band.voxelSize));
    const auto width = hn::Set(d, band.width());
    for (std::size_t x = 0; x < 8; ++x) {
        std::uint64_t word = 0;
        for (std::size_t i = 0; i < 64; i += hn::Lanes(d)) {
            float* at = result.phi + 64 * x + i;
            const auto phi = hn::Load(d, at);
            const auto within = hn::Lt(hn::Abs(phi), limit);
            hn::Store(hn::IfThenElse(within, phi, hn::CopySign(width, phi)), d, at);
            word |= bitsOf(d, within) << i;
        }
        result.active[x] = word;
    }
}

void measureEqual(const Ball* balls, std::size_t count, const Vec3d& origin, const SphereBand& band, SphereLeaf& result)
{
    alignas(64) double squared[512];
    const double radius = balls[0].radius;
    searchEqual(balls, count, origin, radius + band.halfWidthVx, squared);
    for (std::size_t v = 0; v < 512; ++v) result.phi[v] = float((std::sqrt(squared[v]) - radius) * band.voxelSize);
}

void measureAny(const Ball* balls, std::size_t count, const Vec3d& origin, const SphereBand& band, SphereLeaf& result)
{
    Search search;
    const double reach = band.halfWidthVx * (1.0 + kSearchErrorOfBand) + kSearchError;
    std::fill_n(search.distance, 512, float(reach));
    std::fill_n(search.ball, 512, -1);
    for (std::size_t i = 0; i < count; ++i) {
        const auto number = std::int32_t(i);
        if (balls[i].radius > kLargeRadius) {
            searchLarge(balls[i], number, origin, reach, search);
        } else {
            searchSmall(balls[i], number, origin, reach, search);
        }
    }
    for (std::size_t v = 0; v < 512; ++v) {
        double phi = band.halfWidthVx;
        if (search.ball[v] >= 0) {
            const Ball& ball = balls[search.ball[v]];
            const double x = origin.x() + double(v >> 6) - ball.x;
            const double y = origin.y() + double(v >> 3 & 7) - ball.y;
            const double z = origin.z() + double(v & 7) - ball.z;
            phi = std::sqrt(x * x + y * y + z * z) - ball.radius;
        }
        result.phi[v] = float(phi * band.voxelSize);
    }
}

void measureLeaf(const Ball* balls, std::size_t count, const Vec3i& leaf, const SphereBand& band, SphereLeaf& result)
{
    const Vec3d origin = 8.0 * leaf.cast<double>();
    const bool equal = std::all_of(balls, balls + count, [&](const Ball& b) { return b.radius == balls[0].radius; });
    if (equal) {
        measureEqual(balls, count, origin, band, result);
    } else {
        measureAny(balls, count, origin, band, result);
    }
    cutToBand(band, result);
}

} // namespace HWY_NAMESPACE
} // namespace vdbounce
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vdbounce {

HWY_EXPORT(measureLeaf);

void measureSphereLeaf(const Ball* balls, std::size_t count, const Vec3i& leaf, const SphereBand& band,
                       SphereLeaf& result)
{
    HWY_DYNAMIC_DISPATCH(measureLeaf)(balls, count, leaf, band, result);
}

} // namespace vdbounce
#endif
