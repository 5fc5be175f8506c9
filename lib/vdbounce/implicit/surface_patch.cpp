// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/surface_patch.h"

#include "vdbounce/implicit/cell_triangles.h"
#include "vdbounce/implicit/crossed_cells.h"

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

// Second and third derivatives, over the gradient and voxels, beyond which a function counts as kinked: a right angle
// gives 1, a sphere of radius 3 voxels 0.5.
constexpr float kLargestSecond = 0.6f;
constexpr float kLargestThird = 0.3f;

// The patch's point is found when a Newton step is shorter than this, voxels.
constexpr float kFound = 1e-3f;
constexpr int kNewtonSteps = 6;

// How far from the cell's centre along any axis its point may be, voxels: a little beyond its faces at 0.5.
constexpr float kFarthestPoint = 1.0f;

// Derivatives at the middle of four values in a row, of which the outer ones may be unknown (NaN): then lower degree.
struct Line {
    float first;
    float second;
    float third;

    Line(const float* inner, int stride)
    {
        const float f1 = inner[0];
        const float f2 = inner[stride];
        float f0 = inner[-stride];
        float f3 = inner[2 * stride];
        const bool no0 = std::isnan(f0);
        const bool no3 = std::isnan(f3);
        if (no0) f0 = no3 ? 2.0f * f1 - f2 : 3.0f * (f1 - f2) + f3;
        if (no3) f3 = no0 ? 2.0f * f2 - f1 : 3.0f * (f2 - f1) + f0;
        const float step = f2 - f1;
        const float wide = f3 - f0;
        first = (27.0f * step - wide) * (1.0f / 24.0f);
        second = 0.5f * ((f0 + f3) - (f1 + f2));
        third = wide - 3.0f * step;
    }
};

// Means over the four lines of a cell along one axis, and the differences of their second derivatives along the others.
struct Axis {
    float first;
    float second;
    float third;
    float secondAlong[2];

    Axis(const float* cell, int stride, int strideB, int strideC)
    {
        const Line l00(cell, stride);
        const Line l10(cell + strideB, stride);
        const Line l01(cell + strideC, stride);
        const Line l11(cell + strideB + strideC, stride);
        first = 0.25f * ((l00.first + l10.first) + (l01.first + l11.first));
        second = 0.25f * ((l00.second + l10.second) + (l01.second + l11.second));
        third = 0.25f * ((l00.third + l10.third) + (l01.third + l11.third));
        secondAlong[0] = 0.5f * ((l10.second + l11.second) - (l00.second + l01.second));
        secondAlong[1] = 0.5f * ((l01.second + l11.second) - (l00.second + l10.second));
    }
};

// `cell` is the cell's lowest corner.
Cubic fit(const float* cell)
{
    constexpr int kX = SampleBlock::kStrideX;
    constexpr int kY = SampleBlock::kStrideY;
    constexpr int kZ = SampleBlock::kStrideZ;
    const Axis x(cell, kX, kY, kZ);
    const Axis y(cell, kY, kX, kZ);
    const Axis z(cell, kZ, kX, kY);
    const float f000 = cell[0], f001 = cell[kZ], f010 = cell[kY], f011 = cell[kY + kZ];
    const float f100 = cell[kX], f101 = cell[kX + kZ], f110 = cell[kX + kY], f111 = cell[kX + kY + kZ];
    Cubic p;
    const float mean = 0.125f * (((f000 + f001) + (f010 + f011)) + ((f100 + f101) + (f110 + f111)));
    p.c[0] = mean - 0.125f * (x.second + y.second + z.second);
    p.c[1] = x.first - 0.125f * (y.secondAlong[0] + z.secondAlong[0]);
    p.c[2] = y.first - 0.125f * (x.secondAlong[0] + z.secondAlong[1]);
    p.c[3] = z.first - 0.125f * (x.secondAlong[1] + y.secondAlong[1]);
    p.c[4] = 0.5f * x.second;
    p.c[5] = 0.5f * y.second;
    p.c[6] = 0.5f * z.second;
    p.c[7] = 0.5f * (((f110 - f100) - (f010 - f000)) + ((f111 - f101) - (f011 - f001)));
    p.c[8] = 0.5f * (((f101 - f100) - (f001 - f000)) + ((f111 - f110) - (f011 - f010)));
    p.c[9] = 0.5f * (((f011 - f010) - (f001 - f000)) + ((f111 - f110) - (f101 - f100)));
    p.c[10] = x.third / 6.0f;
    p.c[11] = y.third / 6.0f;
    p.c[12] = z.third / 6.0f;
    p.c[13] = 0.5f * x.secondAlong[0];
    p.c[14] = 0.5f * x.secondAlong[1];
    p.c[15] = 0.5f * y.secondAlong[0];
    p.c[16] = 0.5f * y.secondAlong[1];
    p.c[17] = 0.5f * z.secondAlong[0];
    p.c[18] = 0.5f * z.secondAlong[1];
    p.c[19] = ((f111 - f110) - (f101 - f100)) - ((f011 - f010) - (f001 - f000));
    return p;
}

// False for what a cubic cannot stand for: kinks, and where anything is not a number.
bool smooth(const Cubic& cubic, const float (&gradient)[3], const float (&second)[6])
{
    const float g2 = gradient[0] * gradient[0] + gradient[1] * gradient[1] + gradient[2] * gradient[2];
    const float h2 = second[0] * second[0] + second[1] * second[1] + second[2] * second[2] +
                     2.0f * (second[3] * second[3] + second[4] * second[4] + second[5] * second[5]);
    float t2 = 0.0f;
    for (int i = 10; i < 13; ++i) t2 += 36.0f * cubic.c[i] * cubic.c[i];
    for (int i = 13; i < 19; ++i) t2 += 12.0f * cubic.c[i] * cubic.c[i];
    t2 += 6.0f * cubic.c[19] * cubic.c[19];
    return g2 > 0.0f && h2 <= kLargestSecond * kLargestSecond * g2 && t2 <= kLargestThird * kLargestThird * g2;
}

// Scales the cubic to a gradient of length 1 at a point on its zero line near the centre. False where there is none, or
// it is not smooth.
bool findPoint(SurfacePatch& patch)
{
    Cubic& cubic = patch.cubic;
    float u[3] = {0.0f, 0.0f, 0.0f};
    float gradient[3];
    float second[6];
    float step = 1.0f;
    for (int i = 0; i < kNewtonSteps && step > kFound; ++i) {
        float value = 0.0f;
        cubic.at(u, value, gradient, second);
        const float g2 = gradient[0] * gradient[0] + gradient[1] * gradient[1] + gradient[2] * gradient[2];
        if (!(g2 > 0.0f)) return false;
        for (int a = 0; a < 3; ++a) u[a] -= value / g2 * gradient[a];
        step = std::abs(value) / std::sqrt(g2);
        if (!(step < 2.0f)) return false;
    }
    float value = 0.0f;
    cubic.at(u, value, gradient, second);
    const float farthest = std::max(std::abs(u[0]), std::max(std::abs(u[1]), std::abs(u[2])));
    if (!(step <= kFound && farthest <= kFarthestPoint) || !smooth(cubic, gradient, second)) return false;
    const float length = std::sqrt(gradient[0] * gradient[0] + gradient[1] * gradient[1] + gradient[2] * gradient[2]);
    for (float& c : cubic.c) c /= length;
    for (int a = 0; a < 3; ++a) patch.at[a] = u[a];
    return true;
}

} // namespace

void Cubic::at(const float (&u)[3], float& value, float (&gradient)[3], float (&second)[6]) const
{
    const float x = u[0];
    const float y = u[1];
    const float z = u[2];
    second[0] = 2.0f * (c[4] + 3.0f * c[10] * x + c[13] * y + c[14] * z);
    second[1] = 2.0f * (c[5] + 3.0f * c[11] * y + c[15] * x + c[16] * z);
    second[2] = 2.0f * (c[6] + 3.0f * c[12] * z + c[17] * x + c[18] * y);
    second[3] = c[7] + 2.0f * (c[13] * x + c[15] * y) + c[19] * z;
    second[4] = c[8] + 2.0f * (c[14] * x + c[17] * z) + c[19] * y;
    second[5] = c[9] + 2.0f * (c[16] * y + c[18] * z) + c[19] * x;
    gradient[0] = c[1] + x * (2.0f * c[4] + 3.0f * c[10] * x + 2.0f * (c[13] * y + c[14] * z)) +
                  y * (c[7] + c[15] * y) + z * (c[8] + c[17] * z + c[19] * y);
    gradient[1] = c[2] + y * (2.0f * c[5] + 3.0f * c[11] * y + 2.0f * (c[15] * x + c[16] * z)) +
                  x * (c[7] + c[13] * x) + z * (c[9] + c[18] * z + c[19] * x);
    gradient[2] = c[3] + z * (2.0f * c[6] + 3.0f * c[12] * z + 2.0f * (c[17] * x + c[18] * y)) +
                  x * (c[8] + c[14] * x) + y * (c[9] + c[16] * y + c[19] * x);
    value = c[0] + x * (c[1] + x * (c[4] + c[10] * x + c[13] * y + c[14] * z)) +
            y * (c[2] + c[7] * x + y * (c[5] + c[11] * y + c[15] * x + c[16] * z)) +
            z * (c[3] + c[8] * x + c[9] * y + c[19] * x * y + z * (c[6] + c[12] * z + c[17] * x + c[18] * y));
}

void fitPatches(const SampleBlock& block, const Vec3i& origin, const VoxelMetric& metric, LeafPatches& result)
{
    const CrossedCells cells(block);
    if (!cells.any()) return;
    // Unknown values become NaN, which spreads to what would depend on them.
    SampleBlock numbers = block;
    if (!block.allKnown) {
        for (int x = -1; x < 10; ++x) {
            for (int y = -1; y < 10; ++y) {
                for (int z = -1; z < 10; ++z) {
                    if ((block.known[std::size_t(SampleBlock::row(x, y))] >> (z + 1) & 1) == 0)
                        numbers.value[std::size_t(SampleBlock::at(x, y, z))] = std::nanf("");
                }
            }
        }
    }
    for (int x = 0; x < 8; ++x) {
        for (int y = 0; y < 8; ++y) {
            for (int z = 0; z < 8; ++z) {
                if (!cells.crossed(x, y, z)) continue;
                SurfacePatch patch{};
                const int offset[3] = {x, y, z};
                for (int a = 0; a < 3; ++a) patch.cell[a] = origin[a] + offset[a];
                patch.rim = cells.besideCut(x, y, z) ? 1 : 0;
                const int cell = SampleBlock::at(x, y, z);
                patch.cubic = fit(numbers.value.data() + cell);
                if (!findPoint(patch)) addTriangles(block.value.data() + cell, metric, patch, result.triangles);
                result.patches.push_back(patch);
            }
        }
    }
}

} // namespace vdbounce
