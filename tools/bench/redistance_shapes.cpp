// SPDX-License-Identifier: Apache-2.0
#include "bench/redistance_shapes.h"

#include "vdbounce/field/grid_assembly.h"
#include "vdbounce/io/openvdb_grid.h"

#include <openvdb/tools/SignedFloodFill.h>

#include <algorithm>
#include <cmath>

namespace vdbounce::bench {
namespace {

using Leaf = openvdb::FloatTree::LeafNodeType;

// Off the lattice, so that nothing is found by symmetry.
const Vec3d kCentre(-0.013, -0.0171, -0.0093);

constexpr double kHalfWidthVx = 3.0;
constexpr double kExtent = 1.3; // of the largest shape, with its band

constexpr double kSlotHalfWidth = 1.0 / 6.0;
constexpr double kSlotTop = 2.0 / 3.0;
constexpr double kHalfHeight = 0.5;

double toSegment(double x, double y, double ax, double ay, double bx, double by)
{
    const double dx = bx - ax;
    const double dy = by - ay;
    const double t = std::min(std::max(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0.0), 1.0);
    return std::hypot(x - ax - t * dx, y - ay - t * dy);
}

double slottedCircle(double x, double y)
{
    const double mouth = -std::sqrt(1.0 - kSlotHalfWidth * kSlotHalfWidth);
    const double radius = std::hypot(x, y);
    const bool belowSlot = std::abs(x) < kSlotHalfWidth * radius && y < 0.0;
    double distance = belowSlot ? 2.0 : std::abs(radius - 1.0);
    for (const double side : {-kSlotHalfWidth, kSlotHalfWidth})
        distance = std::min(distance, toSegment(x, y, side, mouth, side, kSlotTop));
    distance = std::min(distance, toSegment(x, y, -kSlotHalfWidth, kSlotTop, kSlotHalfWidth, kSlotTop));
    const bool inSlot = std::abs(x) < kSlotHalfWidth && y < kSlotTop;
    return radius < 1.0 && !inSlot ? -distance : distance;
}

double slottedDiscPhi(const Vec3d& p)
{
    const double across = slottedCircle(p.x(), p.y());
    const double along = std::abs(p.z()) - kHalfHeight;
    return std::min(std::max(across, along), 0.0) + std::hypot(std::max(across, 0.0), std::max(along, 0.0));
}

bool awayFromDiscEdges(const Vec3d& p, double distance)
{
    if (std::abs(std::abs(p.z()) - kHalfHeight) < distance) return false;
    const bool besideSlot = std::abs(std::abs(p.x()) - kSlotHalfWidth) < distance;
    const bool atMouth = p.y() < 0.0 && std::abs(std::hypot(p.x(), p.y()) - 1.0) < distance;
    return !besideSlot || (std::abs(p.y() - kSlotTop) >= distance && !atMouth);
}

bool always(const Vec3d&, double) { return true; }

} // namespace

RedistanceShape unitSphere()
{
    return {"sphere", [](const Vec3d& p) { return (p - kCentre).norm() - 1.0; }, always};
}

RedistanceShape unitTorus()
{
    const auto phi = [](const Vec3d& at) {
        const Vec3d p = at - kCentre;
        return std::hypot(std::hypot(p.x(), p.z()) - 0.8, p.y()) - 0.3;
    };
    return {"torus", phi, always};
}

RedistanceShape slottedDisc()
{
    return {"Zalesak's disc", [](const Vec3d& p) { return slottedDiscPhi(p - kCentre); },
            [](const Vec3d& p, double distance) { return awayFromDiscEdges(p - kCentre, distance); }};
}

std::vector<Distortion> distortions()
{
    return {{"exact", [](double phi, const Vec3d&) { return phi; }},
            {"phi^3 + phi", [](double phi, const Vec3d&) { return phi * phi * phi + phi; }},
            {"phi^2 + 2 phi", [](double phi, const Vec3d&) { return phi * phi + 2.0 * phi; }},
            {"phi (1 + sin/2)", [](double phi, const Vec3d& p) {
                 return phi * (1.0 + 0.5 * std::sin(4.0 * p.x()) * std::sin(3.0 * p.y() + 1.0) * std::cos(5.0 * p.z()));
             }}};
}

ScalarGrid distortedLevelSet(const RedistanceShape& shape, const Distortion& distortion, double voxelSize)
{
    const double width = kHalfWidthVx * voxelSize;
    auto grid = openvdb::FloatGrid::create(std::nextafter(float(width), 2.0f));
    grid->setTransform(openvdb::math::Transform::createLinearTransform(voxelSize));
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    const int reach = int(kExtent / voxelSize) / 8 + 1;
    const int side = 2 * reach;
    addLeaves(*grid, std::size_t(side) * std::size_t(side) * std::size_t(side), [&](std::size_t i) {
        const int n = int(i);
        const openvdb::Coord origin(8 * (n / side / side - reach), 8 * (n / side % side - reach),
                                    8 * (n % side - reach));
        const Vec3d first(origin.x(), origin.y(), origin.z());
        // Half the diagonal of a leaf is 6.1 voxels.
        if (std::abs(shape.phi(voxelSize * (first + Vec3d::Constant(3.5)))) > width + 6.2 * voxelSize)
            return std::unique_ptr<Leaf>();
        auto leaf = std::make_unique<Leaf>(origin, grid->background());
        for (openvdb::Index v = 0; v < Leaf::SIZE; ++v) {
            const openvdb::Coord c = leaf->offsetToGlobalCoord(v);
            const Vec3d p = voxelSize * Vec3d(c.x(), c.y(), c.z());
            const double phi = shape.phi(p);
            if (std::abs(phi) < width) {
                leaf->setValueOn(v, float(distortion.value(phi, p)));
            } else {
                leaf->setValueOff(v, phi < 0.0 ? -grid->background() : grid->background());
            }
        }
        return leaf->isEmpty() ? nullptr : std::move(leaf);
    });
    openvdb::tools::signedFloodFill(grid->tree());
    return toScalarGrid(openvdb::FloatGrid::ConstPtr(grid));
}

} // namespace vdbounce::bench
