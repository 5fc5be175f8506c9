// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/random.h"

#include "vdbounce/field/distance_field.h"

#include <Eigen/Geometry>
#include <openvdb/tools/SignedFloodFill.h>

#include <cmath>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

using openvdb::Coord;
using openvdb::math::Transform;

struct Reference {
    double phi;
    Vec3d gradient; // world
};

// The definition, in double precision through the public accessor: trilinear phi, and central differences at the 8
// voxels around the point interpolated the same way and carried to world space by the transform's inverse transpose.
Reference reference(const openvdb::FloatGrid& grid, const openvdb::FloatGrid::ConstAccessor& accessor,
                    const Vec3d& world)
{
    const openvdb::Vec3d index = grid.worldToIndex(openvdb::Vec3d(world.x(), world.y(), world.z()));
    const Coord base = Coord::floor(index);
    Reference result{0.0, Vec3d::Zero()};
    openvdb::Vec3d gradient(0.0);
    const auto at = [&](const Coord& c) { return double(accessor.getValue(c)); };
    for (int corner = 0; corner < 8; ++corner) {
        const Coord offset(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
        double weight = 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            const double t = index[axis] - base[axis];
            weight *= offset[axis] == 1 ? t : 1.0 - t;
        }
        const Coord c = base + offset;
        result.phi += weight * at(c);
        gradient[0] += weight * 0.5 * (at(c.offsetBy(1, 0, 0)) - at(c.offsetBy(-1, 0, 0)));
        gradient[1] += weight * 0.5 * (at(c.offsetBy(0, 1, 0)) - at(c.offsetBy(0, -1, 0)));
        gradient[2] += weight * 0.5 * (at(c.offsetBy(0, 0, 1)) - at(c.offsetBy(0, 0, -1)));
    }
    const openvdb::Vec3d carried = grid.transform().baseMap()->applyIJT(gradient);
    result.gradient = Vec3d(carried[0], carried[1], carried[2]);
    return result;
}

Transform::Ptr sheared()
{
    Mat3d rows;
    rows << 0.1, 0.02, 0, -0.03, 0.2, 0.04, 0.01, 0, 0.15;
    return affineTransform(rows, Vec3d(3, -2, 1));
}

Transform::Ptr rotated()
{
    auto transform = Transform::createLinearTransform(0.1);
    transform->postRotate(0.7, openvdb::math::X_AXIS);
    transform->postRotate(-0.4, openvdb::math::Z_AXIS);
    transform->postTranslate(openvdb::Vec3d(-1, 5, 0.3));
    return transform;
}

Transform::Ptr mirrored() { return affineTransform(Vec3d(-0.1, 0.1, 0.1).asDiagonal(), Vec3d::Zero()); }

Transform::Ptr longVoxels() { return affineTransform(Vec3d(0.1, 0.2, 0.05).asDiagonal(), Vec3d(0.01, 0.02, 0.03)); }

Vec3d indexToWorld(const openvdb::FloatGrid& grid, const Vec3d& index)
{
    const openvdb::Vec3d world = grid.indexToWorld(openvdb::Vec3d(index.x(), index.y(), index.z()));
    return Vec3d(world[0], world[1], world[2]);
}

// Compares field and definition at random points of the active voxels' box. Without a macro a point, of which there are
// millions.
void requireDefinition(const openvdb::FloatGrid::Ptr& grid, Random& random, int points)
{
    const DistanceField field(levelSet(grid));
    const auto accessor = grid->getConstAccessor();
    const double ulps = 8.0 * std::numeric_limits<float>::epsilon() * grid->background();
    const double perVoxel = ulps / field.voxelSize();
    for (int i = 0; i < points; ++i) {
        const Vec3d world = indexToWorld(*grid, random.in(field.indexBox()));
        if (!field.indexBox().contains(field.transform().toIndex(world))) continue; // rounded out of the box
        const Reference expected = reference(*grid, accessor, world);
        const FieldSample sample = field.sample(world);
        const double error = std::max(std::abs(sample.phi - expected.phi), std::abs(field.phi(world) - expected.phi));
        if (error <= ulps && (sample.gradient - expected.gradient).norm() <= perVoxel) continue;
        FAIL("at " << world.transpose() << ": " << sample.phi << " and " << sample.gradient.transpose() << ", expected "
                   << expected.phi << " and " << expected.gradient.transpose());
    }
}

} // namespace

TEST_CASE("lookup is trilinear with interpolated central differences under any affine transform")
{
    VDBOUNCE_RANDOM(random);
    const std::pair<const char*, Transform::Ptr> transforms[] = {{"uniform", uniformTransform(0.1)},
                                                                 {"rotated", rotated()},
                                                                 {"sheared", sheared()},
                                                                 {"mirrored", mirrored()},
                                                                 {"long voxels", longVoxels()}};
    for (const auto& [name, transform] : transforms) {
        INFO(name);
        const openvdb::Vec3d middle = transform->indexToWorld(openvdb::Vec3d(-3, 2, 1));
        const Phi phi = sphere(1.2, Vec3d(middle[0], middle[1], middle[2]));
        requireDefinition(bandGrid(phi, transform, 24), random, 1000000);
        requireDefinition(denseGrid(phi, transform, 12), random, 1000000);
    }
}

TEST_CASE("lookup is right across leaf, node and tile borders and in tiles")
{
    VDBOUNCE_RANDOM(random);
    // Leaves, tiles of every level, active and not, with values that differ from neighbour to neighbour.
    auto grid = openvdb::FloatGrid::create(3.0f);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    grid->fill(openvdb::CoordBBox(Coord(-140, -130, -8), Coord(140, 140, 140)), 2.0f, true);
    grid->fill(openvdb::CoordBBox(Coord(0, 0, 0), Coord(127, 127, 127)), -2.5f, true);
    grid->fill(openvdb::CoordBBox(Coord(-64, -16, 8), Coord(-57, 7, 15)), -1.0f, false);
    for (int i = 0; i < 4000; ++i) {
        const Vec3d p = random.in(Box{Vec3d(-130, -130, -8), Vec3d(0, 10, 130)});
        grid->tree().setValueOn(Coord(int(p.x()), int(p.y()), int(p.z())), float(random.uniform(-3, 3)));
    }
    requireDefinition(grid, random, 1000000);
    // Close to borders of leaves and nodes, where stencils reach across.
    const DistanceField field(levelSet(grid));
    const auto accessor = grid->getConstAccessor();
    for (int i = 0; i < 100000; ++i) {
        Vec3d p = random.in(Box{Vec3d(-139, -129, -7), Vec3d(138, 138, 138)});
        const int axis = i % 3;
        p[axis] = std::round(p[axis] / 8.0) * 8.0 + random.uniform(-2, 2);
        if (!field.indexBox().contains(p)) continue;
        const Reference expected = reference(*grid, accessor, p);
        INFO("at " << p.transpose());
        REQUIRE(field.phi(p) == Approx(expected.phi).margin(1e-6));
        REQUIRE((field.sample(p).gradient - expected.gradient).norm() <= 1e-6);
    }
}

TEST_CASE("pieces far apart are found")
{
    auto grid = openvdb::FloatGrid::create(3.0f);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    const Coord places[] = {Coord(0, 0, 0), Coord(1000000000, -1000000000, 5), Coord(-1234567, 7654321, -99)};
    for (int i = 0; i < 3; ++i) grid->tree().setValueOn(places[i], float(-1 - i));
    const DistanceField field(levelSet(grid));
    for (int i = 0; i < 3; ++i) CHECK(field.phi(Vec3d(places[i].x(), places[i].y(), places[i].z())) == -1 - i);
    CHECK(field.phi(Vec3d(500, 500, -50)) == 3.0);
}

TEST_CASE("one voxel and none at all are answered")
{
    auto grid = openvdb::FloatGrid::create(3.0f);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    const DistanceField empty(levelSet(grid->deepCopy()));
    CHECK(empty.empty());
    CHECK(empty.phi(Vec3d(1, 2, 3)) == 3.0);
    CHECK(empty.bounds(Vec3d(1, 2, 3)).lower == 3.0);
    CHECK(empty.bounds(Vec3d(1, 2, 3)).upper == std::numeric_limits<double>::infinity());
    grid->tree().setValueOn(Coord(-5, 6, 7), -0.5f);
    const DistanceField one(levelSet(grid));
    CHECK(one.phi(Vec3d(-5, 6, 7)) == -0.5);
    CHECK(one.phi(Vec3d(-5, 6, 9)) == Approx(-std::hypot(2.0, 0.5)));
}

TEST_CASE("points that are not finite give NaN and no crash")
{
    const DistanceField field(levelSet(bandGrid(sphere(1.0), uniformTransform(0.1), 16)));
    for (const Vec3d& p : {Vec3d(std::nan(""), 0, 0), Vec3d(0, std::numeric_limits<double>::infinity(), 0)}) {
        CHECK(std::isnan(field.phi(p)));
        CHECK(std::isnan(field.sample(p).phi));
        CHECK(std::isnan(field.bounds(p).lower));
    }
}

TEST_CASE("a sphere's field is a distance: values within 2e-4 and normals within 2 degrees")
{
    VDBOUNCE_RANDOM(random);
    // 64 voxels a side, as in the field study.
    const double radius = 0.5;
    const double voxel = 1.2 / 64;
    const DistanceField field(levelSet(bandGrid(sphere(radius), uniformTransform(voxel), 34, 5.0)));
    double sum = 0.0;
    double worstAngle = 0.0;
    const int points = 100000;
    for (int i = 0; i < points; ++i) {
        const Vec3d direction = random.direction();
        const double distance = random.uniform(-2, 2) * voxel;
        const FieldSample sample = field.sample((radius + distance) * direction);
        sum += std::abs(sample.phi - distance);
        worstAngle = std::max(worstAngle, std::acos(std::min(1.0, sample.gradient.normalized().dot(direction))));
    }
    CHECK(sum / points < 2e-4);
    CHECK(worstAngle * 180 / M_PI < 2.0);
}

TEST_CASE("outside the box phi is the lower bound, continuous, with its own derivative as gradient")
{
    VDBOUNCE_RANDOM(random);
    for (const Transform::Ptr& transform : {uniformTransform(0.1), rotated(), sheared()}) {
        const openvdb::Vec3d middle = transform->indexToWorld(openvdb::Vec3d(0, 0, 0));
        const DistanceField field(
            levelSet(denseGrid(sphere(0.9, Vec3d(middle[0], middle[1], middle[2])), transform, 14)));
        const double h = 1e-6;
        int kinks = 0;
        for (int i = 0; i < 3000; ++i) {
            const Vec3d p = field.transform().toWorld(20.0 * random.direction() +
                                                      random.in(Box{Vec3d::Constant(-12), Vec3d::Constant(12)}));
            if (field.indexBox().contains(field.transform().toIndex(p))) continue;
            const FieldSample sample = field.sample(p);
            REQUIRE(sample.phi == Approx(field.phi(p)).epsilon(1e-12));
            Vec3d numeric;
            for (int axis = 0; axis < 3; ++axis)
                numeric[axis] = (field.phi(p + h * Vec3d::Unit(axis)) - field.phi(p - h * Vec3d::Unit(axis))) / (2 * h);
            // The difference may straddle a kink, where the closest point passes from cell to cell; that is rare at
            // this h.
            if ((sample.gradient - numeric).norm() > 1e-3) ++kinks;
        }
        CHECK(kinks <= 3);
    }
}

TEST_CASE("the Lipschitz bound holds between any two points of the box")
{
    VDBOUNCE_RANDOM(random);
    for (const Transform::Ptr& transform : {uniformTransform(0.1), sheared(), longVoxels()}) {
        const openvdb::Vec3d middle = transform->indexToWorld(openvdb::Vec3d(0, 0, 0));
        const DistanceField field(
            levelSet(bandGrid(sphere(0.9, Vec3d(middle[0], middle[1], middle[2])), transform, 24)));
        CHECK(field.lipschitz() >= 1.0);
        CHECK(field.lipschitz() < 1.8);
        for (int i = 0; i < 50000; ++i) {
            const Vec3d a = field.transform().toWorld(random.in(field.indexBox()));
            const Vec3d b = a + std::pow(10.0, random.uniform(-4, 0)) * random.direction();
            REQUIRE(std::abs(field.phi(a) - field.phi(b)) <= field.lipschitz() * (a - b).norm() * (1 + 1e-9) + 1e-7);
        }
    }
}

// Beside the sides of the box the values jump to the background, which no lookup reads.
TEST_CASE("the Lipschitz bound of a surface that its box cuts off does not count what is beyond the box")
{
    const DistanceField cut(levelSet(denseGrid(halfSpace(Vec3d(0.6, 0.8, 0.0)), uniformTransform(0.1), 24)));
    REQUIRE(cut.clipped());
    CHECK(cut.lipschitz() < std::sqrt(3.0));
    FieldOptions cubic;
    cubic.lookup = Lookup::Cubic; // reads them
    const DistanceField smooth(levelSet(denseGrid(halfSpace(Vec3d(0.6, 0.8, 0.0)), uniformTransform(0.1), 24)), cubic);
    CHECK(smooth.lipschitz() > 5.0);
}
