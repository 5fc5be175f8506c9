// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/random.h"

#include "vdbounce/field/distance_field.h"

#include <cmath>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

DistanceField fieldOf(const openvdb::FloatGrid::Ptr& grid, Lookup lookup, Normal normal)
{
    return DistanceField(levelSet(grid), {lookup, normal, Storage::Float});
}

openvdb::math::Transform::Ptr skewed()
{
    Mat3d rows;
    rows << 0.1, 0.02, 0, -0.03, 0.12, 0.04, 0.01, 0, 0.11;
    return affineTransform(rows, Vec3d(3, -2, 1));
}

// phi's derivative by differences, where phi is smooth.
Vec3d differences(const DistanceField& field, const Vec3d& p, double step)
{
    Vec3d gradient;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3d offset = step * Vec3d::Unit(axis);
        gradient[axis] = (field.phi(p + offset) - field.phi(p - offset)) / (2.0 * step);
    }
    return gradient;
}

// A point of the box whose place in its cell is away from the cell's sides.
Vec3d inACell(const DistanceField& field, Random& random)
{
    Box box = field.indexBox();
    box.min += Vec3d::Constant(2.0);
    box.max -= Vec3d::Constant(2.0);
    const Vec3d floored = random.in(box).array().floor();
    return field.transform().toWorld(floored + random.in(Box{Vec3d::Constant(0.01), Vec3d::Constant(0.99)}));
}

} // namespace

TEST_CASE("the nearest lookup is the value of the nearest voxel")
{
    VDBOUNCE_RANDOM(random);
    const auto grid = bandGrid(sphere(1.2, Vec3d(3, -2, 1)), skewed(), 24);
    const DistanceField field = fieldOf(grid, Lookup::Nearest, Normal::Central);
    for (int i = 0; i < 100000; ++i) {
        const Vec3d index = random.in(field.indexBox());
        const openvdb::Coord voxel = openvdb::Coord::round(openvdb::Vec3d(index.x(), index.y(), index.z()));
        const Vec3d world = field.transform().toWorld(index);
        if ((index - index.array().round().matrix()).cwiseAbs().maxCoeff() > 0.4999) continue; // a tie
        REQUIRE(field.phi(world) == grid->tree().getValue(voxel));
        REQUIRE(field.sample(world).phi == field.phi(world));
        // A ball with nothing in it: no point in reach is inside.
        const double free = field.freeDistance(world, field.phi(world)) / field.lipschitz();
        if (free > 0.0) REQUIRE(field.phi(world + free * random.direction()) >= 0.0);
    }
}

TEST_CASE("analytic gradients are the derivatives of phi")
{
    VDBOUNCE_RANDOM(random);
    const auto grid = denseGrid(sphere(0.9, Vec3d(3, -2, 1)), skewed(), 12);
    for (Lookup lookup : {Lookup::Trilinear, Lookup::Cubic}) {
        const DistanceField field = fieldOf(grid, lookup, Normal::Analytic);
        for (int i = 0; i < 20000; ++i) {
            const Vec3d p = inACell(field, random);
            REQUIRE((field.sample(p).gradient - differences(field, p, 1e-5)).norm() <= 1e-4);
            REQUIRE(field.sample(p).phi == Approx(field.phi(p)).margin(1e-12));
        }
    }
}

TEST_CASE("the cubic lookup meets every voxel's value, is C1, and exact for quadratic functions")
{
    VDBOUNCE_RANDOM(random);
    const Phi quadratic = [](const Vec3d& p) {
        return 0.3 + p.x() * p.x() - 0.5 * p.y() * p.y() + 0.25 * p.x() * p.z() + p.y();
    };
    const DistanceField smooth =
        fieldOf(denseGrid(quadratic, uniformTransform(0.1), 12), Lookup::Cubic, Normal::Analytic);
    for (int i = 0; i < 20000; ++i) {
        const Vec3d p = inACell(smooth, random);
        REQUIRE(smooth.phi(p) == Approx(quadratic(p)).margin(1e-6));
        REQUIRE(smooth.sample(p).gradient.y() == Approx(1.0 - p.y()).margin(1e-5));
    }

    auto rough = denseGrid([&](const Vec3d&) { return random.uniform(-1, 1); }, uniformTransform(1.0), 9);
    const DistanceField field = fieldOf(rough, Lookup::Cubic, Normal::Analytic);
    for (int i = 0; i < 20000; ++i) {
        Vec3d p = random.in(Box{Vec3d::Constant(-7), Vec3d::Constant(7)});
        const Vec3d voxel = p.array().round();
        REQUIRE(field.phi(voxel) ==
                Approx(rough->tree().getValue(openvdb::Coord(int(voxel.x()), int(voxel.y()), int(voxel.z()))))
                    .margin(1e-6));
        // From one cell to the next both the value and the gradient go on.
        p[i % 3] = voxel[i % 3];
        const Vec3d offset = 1e-9 * Vec3d::Unit(i % 3);
        const FieldSample before = field.sample(p - offset);
        const FieldSample after = field.sample(p + offset);
        REQUIRE(before.phi == Approx(after.phi).margin(1e-7));
        REQUIRE((before.gradient - after.gradient).norm() <= 1e-6);
    }
}

TEST_CASE("no lookup changes faster than its Lipschitz bound")
{
    VDBOUNCE_RANDOM(random);
    auto rough = denseGrid([&](const Vec3d&) { return random.uniform(-1, 1); }, skewed(), 9);
    for (Lookup lookup : {Lookup::Trilinear, Lookup::Cubic}) {
        const DistanceField field = fieldOf(rough, lookup, Normal::Analytic);
        double steepest = 0.0;
        for (int i = 0; i < 100000; ++i) {
            steepest = std::max(steepest, field.sample(inACell(field, random)).gradient.norm());
        }
        CHECK(steepest <= field.lipschitz());
        CHECK(steepest >= 0.03 * field.lipschitz()); // the bound says something, though the background makes it steeper
    }
}

TEST_CASE("values in fewer bits are off by no more than is said")
{
    VDBOUNCE_RANDOM(random);
    // Ordinary voxels, and ones so small and so large that an unscaled half float could not hold their distances.
    for (double voxel : {0.05, 1e-4, 1e7}) {
        for (const auto& grid : {bandGrid(sphere(20 * voxel), uniformTransform(voxel), 26),
                                 denseGrid(sphere(8 * voxel), uniformTransform(voxel), 12)}) {
            const DistanceField exact(levelSet(grid));
            double largest = grid->background();
            for (auto it = grid->cbeginValueOn(); it; ++it) largest = std::max(largest, std::abs(double(*it)));
            CHECK(exact.storageError() == 0.0);
            for (Storage storage : {Storage::Half, Storage::Fixed8}) {
                INFO("voxel " << voxel << ", storage " << int(storage));
                const DistanceField field(levelSet(grid), {Lookup::Trilinear, Normal::Central, storage});
                // What the header promises before anything is measured.
                const double range = storage == Storage::Half ? largest / 2048 + 2e-9 * largest : 2 * largest / 510;
                CHECK(field.storageError() > 0.0);
                CHECK(field.storageError() <= 1.001 * range);
                for (int i = 0; i < 20000; ++i) {
                    const Vec3d p = exact.transform().toWorld(random.in(exact.indexBox()));
                    const FieldSample a = exact.sample(p);
                    const FieldSample b = field.sample(p);
                    REQUIRE(std::abs(a.phi - b.phi) <= field.storageError() * (1 + 1e-6));
                    REQUIRE((a.gradient - b.gradient).cwiseAbs().maxCoeff() <=
                            field.storageError() / voxel * (1 + 1e-6));
                    const Interval bounds = field.bounds(p);
                    REQUIRE(bounds.lower <= p.norm() - (largest < 5 * voxel ? 20 : 8) * voxel + 1e-6 * voxel);
                    REQUIRE(bounds.upper >= p.norm() - (largest < 5 * voxel ? 20 : 8) * voxel - 1e-6 * voxel);
                }
            }
        }
    }
}

TEST_CASE("phi is one and the same alone and with its gradient, outside of the box too")
{
    VDBOUNCE_RANDOM(random);
    const auto grid = bandGrid(sphere(1.0, Vec3d(0.01, 0.02, 0.03)), skewed(), 24);
    for (Lookup lookup : {Lookup::Nearest, Lookup::Trilinear, Lookup::Cubic}) {
        for (Normal normal : {Normal::Central, Normal::Analytic}) {
            const DistanceField field = fieldOf(grid, lookup, normal);
            for (int i = 0; i < 10000; ++i) {
                const Vec3d p = field.worldBox().centre() + 2.0 * random.uniform(0, 1) * random.direction();
                REQUIRE(field.sample(p).phi == Approx(field.phi(p)).margin(1e-12));
            }
        }
    }
}
