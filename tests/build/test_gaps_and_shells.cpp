// SPDX-License-Identifier: Apache-2.0
#include "support/meshes.h"

#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/io/openvdb_grid.h"

#include <Eigen/Geometry>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

constexpr int kLevel = 4;           // 2048 triangles a sphere
constexpr double kOnSurface = 1e-6; // so close to a corner of the mesh rounding may decide

openvdb::FloatGrid::ConstPtr converted(const TriangleMesh& mesh, double voxelSize)
{
    MeshToLevelSetOptions options;
    options.voxelSize = voxelSize;
    return toOpenVdb(meshToLevelSet(mesh, options).grid).deepCopy();
}

// Counts voxel centres on the wrong side in a cube; `inside` says 1, 0, or -1 where it cannot tell.
struct Sides {
    std::size_t wrongInside = 0;
    std::size_t wrongOutside = 0;
    std::size_t insideCount = 0;
    std::size_t outsideCount = 0;
};
Sides countSides(const openvdb::FloatGrid& grid, double reach, const std::function<int(const Vec3d&)>& inside)
{
    const auto accessor = grid.getConstAccessor();
    const double voxelSize = grid.voxelSize()[0];
    const int side = int(reach / voxelSize);
    Sides sides;
    for (const openvdb::Coord& c : openvdb::CoordBBox(openvdb::Coord(-side), openvdb::Coord(side))) {
        const int expected = inside(voxelSize * Vec3d(c.x(), c.y(), c.z()));
        if (expected < 0) continue;
        const bool negative = accessor.getValue(c) < 0.0f;
        ++(expected == 1 ? sides.insideCount : sides.outsideCount);
        if (expected == 1 && !negative) ++sides.wrongInside;
        if (expected == 0 && negative) ++sides.wrongOutside;
    }
    return sides;
}

// A sphere's triangles lie between this share of its radius and the radius.
double innerShare()
{
    const TriangleMesh ball = sphereMesh(1.0, kLevel);
    double nearest = 1.0;
    for (std::size_t t = 0; t < ball.triangles.size(); ++t) {
        const Vec3d& a = ball.corner(t, 0);
        nearest = std::min(nearest, a.dot((ball.corner(t, 1) - a).cross(ball.corner(t, 2) - a).normalized()));
    }
    return nearest;
}

} // namespace

TEST_CASE("every voxel centre in the gap between two spheres is outside")
{
    const double share = innerShare();
    for (double voxel : {0.03, 0.05, 0.07, 0.09}) {
        for (double shift : {0.0, 0.02}) { // voxel centres lie elsewhere in the gap
            const Vec3d left(-0.55 + shift, 0, 0);
            const Vec3d right(0.55 + shift, 0, 0);
            const auto grid = converted(joined(sphereMesh(0.5, kLevel, left), sphereMesh(0.5, kLevel, right)), voxel);
            const Sides sides = countSides(*grid, 0.6, [&](const Vec3d& p) {
                const double r = std::min((p - left).norm(), (p - right).norm());
                return r > 0.5 + kOnSurface ? 0 : r < 0.5 * share ? 1 : -1;
            });
            INFO("a gap of 0.1 around " << shift << " at voxel " << voxel);
            CHECK(grid->getConstAccessor().getValue(openvdb::Coord(0)) > 0.0f); // in the gap, on the line of centres
            CHECK(sides.wrongOutside == 0);
            CHECK(sides.wrongInside == 0);
            CHECK(sides.outsideCount > 100);
            CHECK(sides.insideCount > 100);
        }
    }
}

TEST_CASE("the cavity of a shell is outside down to a wall of half a voxel")
{
    const double share = innerShare();
    const double voxel = 0.06;
    for (double wallVx : {4.0, 2.0, 1.3, 1.0, 0.7, 0.5}) {
        for (bool outward : {false, true}) { // the inner surface faces into the cavity, as it should, or out of it
            const double inner = 1.0 - wallVx * voxel;
            const TriangleMesh cavity = sphereMesh(inner, kLevel);
            const auto grid = converted(joined(sphereMesh(1.0, kLevel), outward ? cavity : flipped(cavity)), voxel);
            const Sides sides = countSides(*grid, 1.3, [&](const Vec3d& p) {
                const double r = p.norm();
                if (r > 1.0 + kOnSurface || r < inner * share) return 0;
                return r > inner + kOnSurface && r < share ? 1 : -1;
            });
            INFO("a wall of " << wallVx << " voxels, inner surface facing " << (outward ? "out of" : "into")
                              << " the cavity");
            CHECK(grid->getConstAccessor().getValue(openvdb::Coord(0)) > 0.0f);
            CHECK(sides.wrongOutside == 0);
            CHECK(sides.wrongInside == 0);
            CHECK(sides.insideCount > 50);
        }
    }
}

TEST_CASE("shells within shells are told apart where walls and cavities are thinner than a voxel")
{
    const double share = innerShare();
    const double voxel = 0.06;
    for (double stepVx : {3.0, 1.0, 0.6}) {
        const double step = stepVx * voxel;
        TriangleMesh mesh = sphereMesh(1.0, kLevel);
        for (int shell = 1; shell < 4; ++shell) mesh = joined(mesh, sphereMesh(1.0 - shell * step, kLevel));
        const auto grid = converted(mesh, voxel);
        const Sides sides = countSides(*grid, 1.2, [&](const Vec3d& p) {
            int around = 0;
            for (int shell = 0; shell < 4; ++shell) {
                const double radius = 1.0 - shell * step;
                if (p.norm() < radius + kOnSurface && p.norm() >= radius * share) return -1;
                if (p.norm() < radius) ++around;
            }
            return around % 2;
        });
        INFO("four shells " << stepVx << " voxels apart");
        CHECK(sides.wrongOutside == 0);
        CHECK(sides.wrongInside == 0);
        CHECK(sides.insideCount > 50);
    }
}
