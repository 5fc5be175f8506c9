// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/meshes.h"
#include "support/random.h"

#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/field/distance_field.h"
#include "vdbounce/field/plane_field.h"
#include "vdbounce/io/mesh_file.h"

#include <openvdb/tools/SignedFloodFill.h>

using namespace vdbounce;
using namespace vdbounce::test;

TEST_CASE("the box rule: a sphere seen from outside its grid")
{
    // Sphere of radius 0.5 in the grid [-0.6, 0.6]^3, seen from (2, 0, 0): lower 1.4036, upper and true 1.5.
    const auto grid = denseGrid(sphere(0.5), uniformTransform(0.05), 12);
    const DistanceField field(levelSet(grid));
    const Interval bounds = field.bounds(Vec3d(2, 0, 0));
    CHECK(bounds.lower == Approx(1.4036).margin(1e-4));
    CHECK(bounds.upper == Approx(1.5).margin(1e-6));
    CHECK(field.phi(Vec3d(2, 0, 0)) == Approx(1.4036).margin(1e-4));
}

TEST_CASE("the box rule: a half space that its box cuts off")
{
    // z < 0.25 on [0, 1]^3, seen from z = -0.5: the larger of the two and the truth are -0.75, and the sign stays
    // inside.
    auto grid = openvdb::FloatGrid::create(1.0f);
    grid->setTransform(uniformTransform(0.05));
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    auto accessor = grid->getAccessor();
    for (int x = 0; x <= 20; ++x) {
        for (int y = 0; y <= 20; ++y) {
            for (int z = 0; z <= 20; ++z) accessor.setValueOn(openvdb::Coord(x, y, z), float(0.05 * z - 0.25));
        }
    }
    const DistanceField field(levelSet(grid));
    CHECK(field.clipped());
    const Interval bounds = field.bounds(Vec3d(0.5, 0.5, -0.5));
    CHECK(bounds.lower == Approx(-0.75).margin(1e-6));
    CHECK(bounds.upper >= -0.75);
    CHECK(field.phi(Vec3d(0.5, 0.5, -0.5)) == Approx(-std::hypot(0.5, 0.25)).margin(1e-6));
    // Beside the box the plane goes on, much nearer than the box: what lies there must not be ruled out.
    VDBOUNCE_RANDOM(random);
    for (int i = 0; i < 100000; ++i) {
        const Vec3d p = std::pow(10.0, random.uniform(-2, 6)) * random.direction() + Vec3d(0.5, 0.5, 0.25);
        const Interval around = field.bounds(p);
        REQUIRE(around.lower <= p.z() - 0.25 + 1e-6 * (1 + p.norm()));
        REQUIRE(around.upper >= p.z() - 0.25 - 1e-6 * (1 + p.norm()));
    }
}

TEST_CASE("bounds hold the true distance anywhere in space")
{
    VDBOUNCE_RANDOM(random);
    auto rotated = uniformTransform(0.1);
    rotated->postRotate(0.6, openvdb::math::Y_AXIS);
    rotated->postTranslate(openvdb::Vec3d(4, -3, 2));
    Mat3d rows;
    rows << 0.1, 0.03, 0, -0.02, 0.12, 0.03, 0, 0.02, 0.09;
    const auto sheared = affineTransform(rows, Vec3d::Ones());
    for (const auto& transform : {uniformTransform(0.1), rotated, sheared}) {
        const openvdb::Vec3d middle = transform->indexToWorld(openvdb::Vec3d(0));
        const Vec3d centre(middle[0], middle[1], middle[2]);
        const Phi phi = sphere(1.1, centre);
        const DistanceField field(levelSet(bandGrid(phi, transform, 24)));
        CHECK_FALSE(field.clipped());
        for (int i = 0; i < 100000; ++i) {
            // In the band, between band and box, deep inside, outside, and up to a million box sizes away.
            const double reach = std::pow(10.0, random.uniform(-2, 6.5));
            const Vec3d p = centre + reach * random.direction();
            const Interval bounds = field.bounds(p);
            const double slack = 1e-6 * (1.0 + reach);
            INFO("at " << p.transpose() << ": " << bounds.lower << " <= " << phi(p) << " <= " << bounds.upper);
            REQUIRE(bounds.lower <= phi(p) + slack);
            REQUIRE(bounds.upper >= phi(p) - slack);
        }
    }
}

TEST_CASE("bounds are tight in the band and exact far away")
{
    VDBOUNCE_RANDOM(random);
    const DistanceField field(levelSet(bandGrid(sphere(1.0), uniformTransform(0.05), 26)));
    for (int i = 0; i < 10000; ++i) {
        const Vec3d direction = random.direction();
        const Interval near = field.bounds(random.uniform(0.95, 1.05) * direction);
        REQUIRE(near.upper - near.lower <= 2.0 * std::sqrt(3.0) * 0.05);
        const Interval far = field.bounds(1e6 * direction);
        REQUIRE(far.lower == Approx(1e6 - 1.0).epsilon(1e-5));
        REQUIRE(far.upper == Approx(1e6 - 1.0).epsilon(1e-5));
    }
}

TEST_CASE("a particle can travel its free distance without phi changing its sign, beside a cut surface too")
{
    VDBOUNCE_RANDOM(random);
    // A slab that reaches through the sides of its box.
    const auto grid = denseGrid(halfSpace(Vec3d(0.2, 1, 0.1)), uniformTransform(0.1), 10);
    const DistanceField field(levelSet(grid));
    REQUIRE(field.clipped());
    for (int i = 0; i < 50000; ++i) {
        const Vec3d p = random.in(Box{Vec3d::Constant(-3), Vec3d::Constant(3)});
        const double phi = field.phi(p);
        if (phi <= 0.0) continue;
        const double free = field.freeDistance(p, phi) / field.lipschitz();
        const Vec3d q = p + random.uniform(0, 1) * free * random.direction();
        INFO(p.transpose() << " to " << q.transpose());
        REQUIRE(field.phi(q) >= -1e-6);
    }
}

TEST_CASE("a plane is exact everywhere")
{
    const PlaneField plane(Vec3d(0, 1, 0), Vec3d(0, 2, 0));
    CHECK(plane.phi(Vec3d(5, 4, 3)) == 3.0);
    CHECK(plane.sample(Vec3d(5, -4, 3)).gradient == Vec3d(0, 1, 0));
    CHECK(plane.bounds(Vec3d(0, 0, 0)).lower == -1.0);
}

TEST_CASE("bounds hold where the band inside is thinner than the one outside")
{
    VDBOUNCE_RANDOM(random);
    auto grid = bandGrid(sphere(1.0), uniformTransform(0.05), 30, 5.0);
    for (auto voxel = grid->beginValueAll(); voxel; ++voxel) {
        if (*voxel > -0.1f) continue;
        voxel.setValue(-0.1f);
        voxel.setValueOff();
    }
    const DistanceField field(levelSet(grid));
    for (int i = 0; i < 20000; ++i) {
        const Vec3d p = random.uniform(0, 1.4) * random.direction();
        const Interval bounds = field.bounds(p);
        REQUIRE(bounds.lower <= p.norm() - 1.0 + 1e-6);
        REQUIRE(bounds.upper >= p.norm() - 1.0 - 1e-6);
    }
}

namespace {

// The union of two overlapping spheres, outside exact, inside and in between with a medial axis that creases.
Phi twoSpheres(double radius, double apart)
{
    const Vec3d centre(apart, 0, 0);
    return [=](const Vec3d& p) { return std::min((p - centre).norm(), (p + centre).norm()) - radius; };
}

} // namespace

TEST_CASE("bounds are within half a leaf's diagonal of the truth anywhere in the box")
{
    VDBOUNCE_RANDOM(random);
    const double halfLeaf = 4.0 * std::sqrt(3.0);
    auto rotated = uniformTransform(1.0);
    rotated->postRotate(0.6, openvdb::math::Y_AXIS);
    // Apart, so that the distance is exact on both sides; in their middle and between them no way is the shortest.
    for (const auto& transform : {uniformTransform(1.0), rotated}) {
        const Phi phi = twoSpheres(25.0, 40.0);
        const DistanceField field(levelSet(bandGrid(phi, transform, 70)));
        double worst = 0.0;
        for (int i = 0; i < 200000; ++i) {
            const Vec3d p = i % 3 == 0   ? Vec3d(0, random.uniform(-20, 20), random.uniform(-20, 20))
                            : i % 3 == 1 ? Vec3d(Vec3d(40, 0, 0) + 8 * random.uniform(0, 1) * random.direction())
                                         : field.transform().toWorld(random.in(field.indexBox()));
            if (!field.indexBox().contains(field.transform().toIndex(p))) continue;
            const Interval bounds = field.bounds(p);
            INFO("at " << p.transpose() << ": " << bounds.lower << " <= " << phi(p) << " <= " << bounds.upper);
            REQUIRE(bounds.lower <= phi(p) + 1e-5);
            REQUIRE(bounds.upper >= phi(p) - 1e-5);
            worst = std::max({worst, phi(p) - bounds.lower, bounds.upper - phi(p)});
        }
        CHECK(worst <= halfLeaf);
        CHECK(worst <= 2.5 * std::sqrt(3.0)); // what the header says
    }
}

TEST_CASE("bounds hold brute-force distances to meshes")
{
    VDBOUNCE_RANDOM(random);
    const TriangleMesh apart = joined(boxMesh(Vec3d(1, 0.3, 0.6)), sphereMesh(0.4, 3, Vec3d(0, 1.2, 0)));
    for (const TriangleMesh& mesh : {apart, readMesh(std::string(VDBOUNCE_SOURCE_DIR) + "/data/bunny.obj")}) {
        const Box box = boundingBox(mesh);
        MeshToLevelSetOptions options;
        options.voxelSize = box.size().maxCoeff() / 90;
        const DistanceField field(meshToLevelSet(mesh, options).grid);
        REQUIRE_FALSE(field.clipped());
        for (int i = 0; i < 3000; ++i) {
            // Half of them around the mesh and in it, half up to a million sizes away.
            const double reach = i % 2 == 0 ? 0.6 : std::pow(10.0, random.uniform(-1, 6));
            const Vec3d p = box.centre() + reach * random.uniform(0, 1) * box.size().norm() * random.direction();
            const double distance = (bruteForceInside(mesh, p) ? -1.0 : 1.0) * bruteForceDistance(mesh, p);
            const Interval bounds = field.bounds(p);
            const double slack = 1e-6 * (options.voxelSize + std::abs(distance));
            INFO("at " << p.transpose() << ": " << bounds.lower << " <= " << distance << " <= " << bounds.upper);
            REQUIRE(bounds.lower <= distance + slack);
            REQUIRE(bounds.upper >= distance - slack);
        }
    }
}

TEST_CASE("from anywhere inside the way to the nearest voxel outside leads out")
{
    VDBOUNCE_RANDOM(random);
    Mat3d rows;
    rows << 1.0, 0.3, 0, -0.2, 1.2, 0.3, 0, 0.2, 0.9;
    for (const auto& transform : {uniformTransform(1.0), affineTransform(rows, Vec3d(5, 6, 7))}) {
        const openvdb::Vec3d middle = transform->indexToWorld(openvdb::Vec3d(0));
        const Vec3d centre(middle[0], middle[1], middle[2]);
        const Phi phi = sphere(30.0, centre);
        const DistanceField field(levelSet(bandGrid(phi, transform, 44)));
        for (int i = 0; i < 20000; ++i) {
            const Vec3d p = centre + 30.0 * std::cbrt(random.uniform(0, 1)) * random.direction();
            const auto outside = field.nearestOutside(p);
            REQUIRE(outside.has_value());
            REQUIRE(phi(*outside) > 0.0);
            REQUIRE(field.phi(*outside) > 0.0);
            REQUIRE((*outside - p).norm() <= -phi(p) + 3.5 * field.transform().voxelDiagonal());
        }
    }
    auto empty = openvdb::FloatGrid::create(1.0f);
    empty->setGridClass(openvdb::GRID_LEVEL_SET);
    CHECK_FALSE(DistanceField(levelSet(empty)).nearestOutside(Vec3d::Zero()).has_value());
}

TEST_CASE("the way out of a box is found through each of its faces, wherever they lie between voxels")
{
    VDBOUNCE_RANDOM(random);
    for (double beyond : {0.05, 0.1, 0.5, 0.95}) {
        const Vec3d corner(20 + beyond, 18 + beyond, 16 + beyond);
        const Phi box = [&](const Vec3d& p) {
            const Vec3d q = p.cwiseAbs() - corner;
            return q.cwiseMax(0.0).norm() + std::min(0.0, q.maxCoeff());
        };
        const DistanceField field(levelSet(bandGrid(box, uniformTransform(1.0), 26)));
        for (int i = 0; i < 2000; ++i) {
            const Vec3d p = random.in(Box{-corner, corner});
            const auto outside = field.nearestOutside(p);
            REQUIRE(outside.has_value());
            REQUIRE(field.phi(*outside) > 0.0);
            REQUIRE((*outside - p).norm() <= -box(p) + 2.5 * std::sqrt(3.0));
        }
    }
}

TEST_CASE("bounds hold far from the origin of index space")
{
    VDBOUNCE_RANDOM(random);
    const openvdb::Coord far(1200000000, -1100000000, 7);
    const auto near = bandGrid(sphere(20.0), uniformTransform(1.0), 26);
    auto grid = openvdb::FloatGrid::create(near->background());
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    auto accessor = grid->getAccessor();
    for (auto it = near->cbeginValueOn(); it; ++it) accessor.setValueOn(it.getCoord() + far, *it);
    openvdb::tools::signedFloodFill(grid->tree());
    const DistanceField field(levelSet(grid));
    for (int i = 0; i < 20000; ++i) {
        const Vec3d p = random.uniform(0, 40) * random.direction();
        const Interval bounds = field.bounds(p + Vec3d(far.x(), far.y(), far.z()));
        REQUIRE(bounds.lower <= p.norm() - 20.0 + 1e-5);
        REQUIRE(bounds.upper >= p.norm() - 20.0 - 1e-5);
    }
}

TEST_CASE("where the box cuts off all of the surface, depth has no bound")
{
    auto grid = openvdb::FloatGrid::create(3.0f);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    grid->fill(openvdb::CoordBBox(openvdb::Coord(0), openvdb::Coord(9)), -3.0f, true);
    grid->tree().setValueOff(openvdb::Coord(20, 0, 0), -3.0f);
    const DistanceField field(levelSet(grid));
    CHECK(field.clipped());
    CHECK(field.bounds(Vec3d::Constant(4.5)).lower <= -100.0);
}
