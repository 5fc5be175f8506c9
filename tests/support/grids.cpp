// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"

#include "vdbounce/io/openvdb_grid.h"

#include <openvdb/tools/SignedFloodFill.h>

namespace vdbounce::test {
namespace {

double phiAt(const Phi& phi, const openvdb::FloatGrid& grid, const openvdb::Coord& voxel)
{
    const openvdb::Vec3d world = grid.indexToWorld(voxel);
    return phi(Vec3d(world.x(), world.y(), world.z()));
}

template <class Body> void forEachVoxel(int side, const Body& body)
{
    for (int x = -side; x <= side; ++x) {
        for (int y = -side; y <= side; ++y) {
            for (int z = -side; z <= side; ++z) body(openvdb::Coord(x, y, z));
        }
    }
}

} // namespace

openvdb::FloatGrid::Ptr bandGrid(const Phi& phi, const openvdb::math::Transform::Ptr& transform, int side,
                                 double halfWidthVx)
{
    openvdb::initialize();
    const openvdb::Vec3d voxel = transform->voxelSize();
    const double width = halfWidthVx * std::min(voxel[0], std::min(voxel[1], voxel[2]));
    auto grid = openvdb::FloatGrid::create(float(width));
    grid->setTransform(transform);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    auto accessor = grid->getAccessor();
    forEachVoxel(side, [&](const openvdb::Coord& c) {
        const double value = phiAt(phi, *grid, c);
        if (std::abs(value) < width) {
            accessor.setValueOn(c, float(value));
        } else if (value < 0.0) {
            accessor.setValueOff(c, -float(width));
        }
    });
    return grid;
}

openvdb::FloatGrid::Ptr denseGrid(const Phi& phi, const openvdb::math::Transform::Ptr& transform, int side)
{
    openvdb::initialize();
    auto grid = openvdb::FloatGrid::create(float(4.0 * side * transform->voxelSize()[0]));
    grid->setTransform(transform);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    auto accessor = grid->getAccessor();
    forEachVoxel(side, [&](const openvdb::Coord& c) { accessor.setValueOn(c, float(phiAt(phi, *grid, c))); });
    return grid;
}

openvdb::math::Transform::Ptr uniformTransform(double voxelSize)
{
    return openvdb::math::Transform::createLinearTransform(voxelSize);
}

openvdb::math::Transform::Ptr affineTransform(const Mat3d& rows, const Vec3d& origin)
{
    openvdb::Mat4d matrix = openvdb::Mat4d::identity();
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) matrix(row, column) = rows(row, column);
        matrix(3, row) = origin[row];
    }
    return openvdb::math::Transform::createLinearTransform(matrix);
}

LevelSetGrid levelSet(const openvdb::FloatGrid::Ptr& grid) { return toLevelSetGrid(grid, "test grid"); }

Phi sphere(double radius, const Vec3d& centre)
{
    return [=](const Vec3d& p) { return (p - centre).norm() - radius; };
}

Phi halfSpace(const Vec3d& normal, double offset)
{
    const Vec3d n = normal.normalized();
    return [=](const Vec3d& p) { return n.dot(p) - offset; };
}

} // namespace vdbounce::test
