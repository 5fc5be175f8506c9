// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/heightfield_mesh.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/parallel.h"

#include <string>

namespace vdbounce {
namespace {

constexpr std::size_t kRowsPerBlock = 16; // some ten thousand samples
constexpr std::uint64_t kMostCells = std::uint64_t(1) << 31;

std::uint32_t sampleNumber(const HeightGrid& grid, int column, int row)
{
    return static_cast<std::uint32_t>(std::int64_t(row) * grid.columns + column);
}

void fillTop(TriangleMesh& mesh, const HeightGrid& grid)
{
    const std::size_t cellColumns = std::size_t(grid.columns - 1);
    forEachIndex(std::size_t(grid.rows), kRowsPerBlock, [&](std::size_t index) {
        const int row = static_cast<int>(index);
        for (int i = 0; i < grid.columns; ++i) {
            mesh.points[sampleNumber(grid, i, row)] =
                grid.origin + Vec3d(i * grid.stepX, *grid.at(i, row), row * grid.stepZ);
        }
        if (row + 1 == grid.rows) return;
        TriangleMesh::Triangle* triangles = mesh.triangles.data() + 2 * index * cellColumns;
        for (int i = 0; i + 1 < grid.columns; ++i) {
            const std::uint32_t first = sampleNumber(grid, i, row);
            const std::uint32_t left = sampleNumber(grid, i, row + 1);
            *triangles++ = {first, left, left + 1};
            *triangles++ = {first, left + 1, first + 1};
        }
    });
}

// The samples around the border, counter-clockwise seen from below: along x, then z, and back.
std::vector<std::uint32_t> borderSamples(const HeightGrid& grid)
{
    std::vector<std::uint32_t> border;
    const int lastColumn = grid.columns - 1;
    const int lastRow = grid.rows - 1;
    for (int i = 0; i < lastColumn; ++i) border.push_back(sampleNumber(grid, i, 0));
    for (int j = 0; j < lastRow; ++j) border.push_back(sampleNumber(grid, lastColumn, j));
    for (int i = lastColumn; i > 0; --i) border.push_back(sampleNumber(grid, i, lastRow));
    for (int j = lastRow; j > 0; --j) border.push_back(sampleNumber(grid, 0, j));
    return border;
}

void addWallsAndBottom(TriangleMesh& mesh, const HeightGrid& grid)
{
    const std::vector<std::uint32_t> border = borderSamples(grid);
    const double base = grid.origin.y() + grid.base;
    const auto ring = static_cast<std::uint32_t>(mesh.points.size());
    for (std::uint32_t sample : border)
        mesh.points.emplace_back(mesh.points[sample].x(), base, mesh.points[sample].z());
    const auto middle = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.emplace_back(grid.origin + Vec3d(0.5 * grid.sizeX(), grid.base, 0.5 * grid.sizeZ()));
    for (std::uint32_t i = 0; i < border.size(); ++i) {
        const std::uint32_t next = i + 1 < border.size() ? i + 1 : 0;
        mesh.triangles.push_back({border[i], border[next], ring + next});
        mesh.triangles.push_back({border[i], ring + next, ring + i});
        mesh.triangles.push_back({ring + i, ring + next, middle});
    }
}

} // namespace

TriangleMesh heightfieldMesh(const HeightMap& map, const HeightfieldOptions& options)
{
    const HeightGrid grid = placeHeightMap(map, options);
    const std::uint64_t cells = std::uint64_t(grid.columns - 1) * std::uint64_t(grid.rows - 1);
    const std::uint64_t border = 2 * (std::uint64_t(grid.columns) + std::uint64_t(grid.rows) - 2);
    if (2 * cells + 3 * border >= 2 * kMostCells) {
        throw UsageError("heightfield map", "has " + std::to_string(cells) + " cells, too many for a mesh",
                         "use a map of less than 2147483648 cells");
    }
    TriangleMesh mesh;
    mesh.points.reserve(map.values.size() + border + 1);
    mesh.triangles.reserve(2 * cells + 3 * border);
    mesh.points.resize(map.values.size());
    mesh.triangles.resize(2 * cells);
    fillTop(mesh, grid);
    addWallsAndBottom(mesh, grid);
    return mesh;
}

} // namespace vdbounce
