// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/heightfield.h"

#include "vdbounce/base/parallel.h"

#include <Eigen/Geometry>

#include <cmath>

namespace vdbounce {
namespace {

// Distance to an edge, relative to the map's size, below which the direction from it is not relied on: at a million
// times machine epsilon it is good to a millionth.
constexpr double kOnEdge = 2e-10;
constexpr std::size_t kRowsPerBlock = 16; // some ten thousand samples

struct Steep {
    bool any = false;
    Steep& operator+=(const Steep& other)
    {
        any = any || other.any;
        return *this;
    }
};

// Some triangle is steeper than 45 degrees.
bool isSteep(const HeightSurface& surface)
{
    const HeightGrid& grid = surface.grid();
    return reduceBlocks(std::size_t(grid.rows - 1), kRowsPerBlock, Steep(),
                        [&](IndexRange rows) {
                            Steep steep;
                            for (std::size_t row = rows.begin; row < rows.end; ++row) {
                                for (int column = 0; column + 1 < grid.columns; ++column) {
                                    const HeightCell cell = surface.cell({column, int(row)});
                                    // Of a normal whose y is 1.
                                    steep.any = steep.any || cell.normal(true).squaredNorm() > 2.0 ||
                                                cell.normal(false).squaredNorm() > 2.0;
                                }
                            }
                            return steep;
                        })
        .any;
}

double thinnestWallOf(const HeightSurface& surface)
{
    const HeightGrid& grid = surface.grid();
    const double bulk = std::min(grid.lowest - grid.base, std::min(grid.sizeX(), grid.sizeZ()));
    return isSteep(surface) ? std::min(bulk, std::min(grid.stepX, grid.stepZ)) : bulk;
}

// The sides of the solid other than the top, by their outward normals, and how far a point inside is from each.
struct Sides {
    double distance[5];

    Sides(const HeightGrid& grid, const Vec3d& p)
        : distance{p.y() - grid.base, p.x(), grid.sizeX() - p.x(), p.z(), grid.sizeZ() - p.z()}
    {
    }
    int nearest() const { return int(std::min_element(distance, distance + 5) - distance); }
    static Vec3d normal(int side)
    {
        const Vec3d normals[5] = {-Vec3d::UnitY(), -Vec3d::UnitX(), Vec3d::UnitX(), -Vec3d::UnitZ(), Vec3d::UnitZ()};
        return normals[side];
    }
};

} // namespace

HeightfieldField::HeightfieldField(const HeightMap& map, const HeightfieldOptions& options)
    : surface_(placeHeightMap(map, options)), thinnestWall_(thinnestWallOf(surface_))
{
}

HeightfieldField::Found HeightfieldField::find(const Vec3d& p, HeightSurface::Cell start) const
{
    const HeightGrid& grid = surface_.grid();
    const double x = std::min(std::max(p.x(), 0.0), grid.sizeX());
    const double z = std::min(std::max(p.z(), 0.0), grid.sizeZ());
    const Vec3d beside(p.x() - x, 0.0, p.z() - z);
    // From below the bottom is nearer than anything above it; from beside, at the height of a wall, the wall.
    if (p.y() <= grid.base) return {std::hypot(beside.norm(), grid.base - p.y()), Where::Below, {}};
    const double height = grid.heightAt(x, z);
    const bool over = beside.squaredNorm() == 0.0;
    if (!over && p.y() <= height) return {beside.norm(), Where::Beside, {}};

    Found found{0.0, Where::Above, {std::numeric_limits<double>::infinity(), {}}};
    if (over && p.y() < height) {
        // The walls' planes end at the top, but where they do not hold the nearest point, the top is nearer than them.
        const Sides sides(grid, p);
        const double side = sides.distance[sides.nearest()];
        found = {0.0, Where::Inside, {side * side, {}}};
    }
    surface_.improve(found.nearest, p, start.column < 0 ? surface_.cellAt(p) : start);
    found.phi = std::sqrt(found.nearest.distance2);
    if (found.where == Where::Inside) found.phi = -found.phi;
    return found;
}

double HeightfieldField::phi(const Vec3d& world, double) const { return find(world - surface_.grid().origin, {}).phi; }

FieldSample HeightfieldField::sample(const Vec3d& world, double) const
{
    const Vec3d p = world - surface_.grid().origin;
    const Found found = find(p, {});
    return {found.phi, gradient(p, found)};
}

void HeightfieldField::phiInRow(const Vec3d& from, const Vec3d& step, int count, double, double* out) const
{
    HeightSurface::Cell start;
    for (int i = 0; i < count; ++i) {
        const Found found = find(from + double(i) * step - surface_.grid().origin, start);
        out[i] = found.phi;
        start = found.nearest.cell;
    }
}

Vec3d HeightfieldField::gradient(const Vec3d& p, const Found& found) const
{
    const HeightGrid& grid = surface_.grid();
    if (found.where == Where::Below || found.where == Where::Beside) {
        const Vec3d solid(std::min(std::max(p.x(), 0.0), grid.sizeX()), found.where == Where::Below ? grid.base : p.y(),
                          std::min(std::max(p.z(), 0.0), grid.sizeZ()));
        const double distance = (p - solid).norm();
        return distance > 0.0 ? Vec3d((p - solid) / distance) : Vec3d(-Vec3d::UnitY());
    }
    if (found.nearest.cell.column < 0) return Sides::normal(Sides(grid, p).nearest());
    return gradientOfSurface(p, found);
}

Vec3d HeightfieldField::gradientOfSurface(const Vec3d& p, const Found& found) const
{
    const HeightCell cell = surface_.cell(found.nearest.cell);
    const HeightCellPart part = found.nearest.part;
    if (part == HeightCellPart::FaceRight || part == HeightCellPart::FaceLeft) {
        return cell.normal(part == HeightCellPart::FaceRight).normalized();
    }
    const Vec3d away = cell.awayFrom(part, p - surface_.corner(found.nearest.cell));
    const double distance = away.norm();
    const HeightGrid& grid = surface_.grid();
    if (distance <= kOnEdge * (grid.sizeX() + grid.sizeZ() + (grid.highest - grid.base))) {
        return cell.normal(part == HeightCellPart::EdgeFront || part == HeightCellPart::EdgeRight).normalized();
    }
    return away / (found.where == Where::Inside ? -distance : distance);
}

Box HeightfieldField::box() const
{
    const HeightGrid& grid = surface_.grid();
    Box box;
    box.add(Vec3d(grid.origin + Vec3d(0.0, grid.base, 0.0)));
    box.add(Vec3d(grid.origin + Vec3d(grid.sizeX(), grid.highest, grid.sizeZ())));
    return box;
}

} // namespace vdbounce
