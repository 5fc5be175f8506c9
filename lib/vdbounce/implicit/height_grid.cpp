// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/height_grid.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/parallel.h"
#include "vdbounce/io/number_text.h"

#include <cmath>
#include <limits>
#include <string>

namespace vdbounce {
namespace {

constexpr std::size_t kSamplesPerBlock = 65536; // half a megabyte: enough to hide the cost of a task
constexpr double kDefaultDepth = 0.1;           // of the bottom below the lowest height, of the longer side

struct HeightRange {
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -std::numeric_limits<double>::infinity();
    bool finite = true;

    HeightRange& operator+=(const HeightRange& other)
    {
        lowest = std::min(lowest, other.lowest);
        highest = std::max(highest, other.highest);
        finite = finite && other.finite;
        return *this;
    }
};

void requireMap(const HeightMap& map)
{
    const bool large = map.columns >= 2 && map.rows >= 2;
    if (large && map.values.size() == std::size_t(map.columns) * std::size_t(map.rows)) return;
    throw UsageError("heightfield map",
                     "has " + std::to_string(map.columns) + " columns, " + std::to_string(map.rows) + " rows and " +
                         std::to_string(map.values.size()) + " values",
                     "give two columns and rows at least, and a value for each of their pairs");
}

void requireSpan(const HeightfieldOptions& options)
{
    const char* names = "xyz";
    for (int axis = 0; axis < 3; ++axis) {
        const double span = options.max[axis] - options.min[axis];
        const bool flat = axis == 1;
        if (std::isfinite(span) && (flat ? span >= 0.0 : span > 0.0)) continue;
        const std::string name(1, names[axis]);
        throw UsageError("heightfield max." + name,
                         "is " + numberText(options.max[axis]) + " where min." + name + " is " +
                             numberText(options.min[axis]),
                         flat ? "give finite numbers, max.y not below min.y" : "give finite numbers, max above min");
    }
}

HeightRange fillHeights(HeightGrid& grid, const HeightMap& map, double span)
{
    grid.heights.resize(map.values.size());
    return reduceBlocks(map.values.size(), kSamplesPerBlock, HeightRange(), [&](IndexRange block) {
        HeightRange range;
        for (std::size_t i = block.begin; i < block.end; ++i) {
            const double height = map.values[i] * span;
            grid.heights[i] = height;
            range.lowest = std::min(range.lowest, height);
            range.highest = std::max(range.highest, height);
            range.finite = range.finite && std::isfinite(height);
        }
        return range;
    });
}

[[noreturn]] void refuseHeight(const HeightGrid& grid, const HeightMap& map)
{
    std::size_t i = 0;
    while (std::isfinite(grid.heights[i])) ++i;
    const std::size_t columns = std::size_t(map.columns);
    throw InputError("heightfield map",
                     "the value in column " + std::to_string(i % columns + 1) + " of row " +
                         std::to_string(i / columns + 1) + " is " + numberText(map.values[i]) +
                         ", which makes no finite height",
                     "correct the map");
}

double chosenBase(const HeightGrid& grid, const HeightfieldOptions& options)
{
    if (!options.base) return grid.lowest - kDefaultDepth * std::max(grid.sizeX(), grid.sizeZ());
    const double base = *options.base - grid.origin.y();
    if (std::isfinite(base) && base < grid.lowest) return base;
    throw UsageError("heightfield base",
                     "is " + numberText(*options.base) + " where the lowest height is " +
                         numberText(grid.origin.y() + grid.lowest),
                     "give a number below that");
}

} // namespace

HeightGrid placeHeightMap(const HeightMap& map, const HeightfieldOptions& options)
{
    requireMap(map);
    requireSpan(options);
    HeightGrid grid;
    grid.origin = options.min;
    grid.columns = map.columns;
    grid.rows = map.rows;
    const Vec3d span = options.max - options.min;
    grid.stepX = span.x() / (map.columns - 1);
    grid.stepZ = span.z() / (map.rows - 1);
    const HeightRange range = fillHeights(grid, map, span.y());
    if (!range.finite) refuseHeight(grid, map);
    grid.lowest = range.lowest;
    grid.highest = range.highest;
    grid.base = chosenBase(grid, options);
    return grid;
}

} // namespace vdbounce
