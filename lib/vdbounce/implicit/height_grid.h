// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"
#include "vdbounce/io/height_map.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace vdbounce {

/// Where a height map lies in the world; world units.
struct HeightfieldOptions {
    /// The map's corner samples lie at min.x, min.z and max.x, max.z: columns along x, rows along z, the first column
    /// and row at min. A value v is the height min.y + v (max.y - min.y), also where v is not within 0 and 1.
    Vec3d min = Vec3d::Zero();
    Vec3d max = Vec3d::Ones(); ///< above min in x and z, not below it in y

    /// y of the flat bottom, below all heights. By default a tenth of the longer horizontal side below the lowest.
    std::optional<double> base;
};

/// A height map in its place: what the distance to a heightfield and its mesh are made from, so that both are of the
/// same triangles. Each cell, between samples (i, j) and (i + 1, j + 1), is cut along the diagonal between these two.
/// All lengths are world units measured from `origin`, which keeps them exact far from the world's.
struct HeightGrid {
    Vec3d origin = Vec3d::Zero(); ///< the place of the first sample, at value 0
    int columns = 0;
    int rows = 0;
    double stepX = 0.0; ///< from column to column
    double stepZ = 0.0; ///< from row to row
    double base = 0.0;
    double lowest = 0.0;
    double highest = 0.0;
    std::vector<double> heights; ///< row by row

    double sizeX() const { return stepX * (columns - 1); }
    double sizeZ() const { return stepZ * (rows - 1); }
    const double* at(int column, int row) const
    {
        return heights.data() + std::size_t(row) * std::size_t(columns) + std::size_t(column);
    }

    /// The cell over or below a place; the nearest where it is beside the map.
    int cellX(double x) const { return cell(x / stepX, columns); }
    int cellZ(double z) const { return cell(z / stepZ, rows); }

    /// The height of the triangles at a place that is not beside the map.
    double heightAt(double x, double z) const
    {
        const int column = cellX(x);
        const int row = cellZ(z);
        const double* h = at(column, row);
        const double u = x / stepX - column;
        const double w = z / stepZ - row;
        const double far = h[columns + 1];
        if (u >= w) return h[0] + u * (h[1] - h[0]) + w * (far - h[1]);
        return h[0] + u * (far - h[columns]) + w * (h[columns] - h[0]);
    }

private:
    // Not a number becomes 0.
    static int cell(double place, int samples)
    {
        return static_cast<int>(std::min(std::max(0.0, place), double(samples - 2)));
    }
};

/// Checks the options and the values, and puts the map in its place. Throws UsageError for options out of range, by
/// name, and for a map that is smaller than 2 x 2 or not as large as it says; InputError for values that are not
/// finite.
HeightGrid placeHeightMap(const HeightMap& map, const HeightfieldOptions& options);

} // namespace vdbounce
