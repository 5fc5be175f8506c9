// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/lipschitz.h"

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

constexpr int kCells = BlockLayout::kRows - 1;

// The largest squared world length of an index-space gradient with |g_i| <= change_i. Convex, so it is at a corner.
double steepestOf(const Vec3d& change, const LinearTransform& transform)
{
    double steepest = 0.0;
    for (int signs = 0; signs < 4; ++signs) {
        const Vec3d g(change.x(), (signs & 1) != 0 ? -change.y() : change.y(),
                      (signs & 2) != 0 ? -change.z() : change.z());
        steepest = std::max(steepest, transform.gradientToWorld(g).squaredNorm());
    }
    return steepest;
}

// The largest difference along each axis in the cells of one row of cells. Plain loops over a row, which the compiler
// turns into vector code.
struct RowChanges {
    float x[kCells];
    float y[kCells];
    float z[kCells];

    explicit RowChanges(const float* v)
    {
        const float* const rows[4] = {v, v + BlockLayout::kStrideY, v + BlockLayout::kStrideX,
                                      v + BlockLayout::kStrideX + BlockLayout::kStrideY};
        float alongX[kCells + 1];
        float alongY[kCells + 1];
        for (int i = 0; i <= kCells; ++i) {
            alongX[i] = std::max(std::abs(rows[2][i] - rows[0][i]), std::abs(rows[3][i] - rows[1][i]));
            alongY[i] = std::max(std::abs(rows[1][i] - rows[0][i]), std::abs(rows[3][i] - rows[2][i]));
        }
        for (int i = 0; i < kCells; ++i) {
            x[i] = std::max(alongX[i], alongX[i + 1]);
            y[i] = std::max(alongY[i], alongY[i + 1]);
            const float near = std::max(std::abs(rows[0][i + 1] - rows[0][i]), std::abs(rows[1][i + 1] - rows[1][i]));
            const float far = std::max(std::abs(rows[2][i + 1] - rows[2][i]), std::abs(rows[3][i + 1] - rows[3][i]));
            z[i] = std::max(near, far);
        }
    }
};

} // namespace

double steepestCell(const float (&block)[BlockLayout::kSize], const LinearTransform& transform, double steepest,
                    const CellRange& range)
{
    for (int x = range.begin.x(); x < range.end.x(); ++x) {
        for (int y = range.begin.y(); y < range.end.y(); ++y) {
            const RowChanges changes(block + x * BlockLayout::kStrideX + y * BlockLayout::kStrideY);
            const auto largest = [](const float(&values)[kCells]) {
                return double(*std::max_element(values, values + kCells));
            };
            // Most rows are less steep, all cells together, than some cell before was.
            if (steepestOf({largest(changes.x), largest(changes.y), largest(changes.z)}, transform) <= steepest)
                continue;
            for (int z = range.begin.z(); z < range.end.z(); ++z) {
                const Vec3d change(changes.x[z], changes.y[z], changes.z[z]);
                steepest = std::max(steepest, steepestOf(change, transform));
            }
        }
    }
    return steepest;
}

} // namespace vdbounce
