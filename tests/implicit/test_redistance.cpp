// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/random.h"

#include "vdbounce/field/vector_lookup.h"
#include "vdbounce/implicit/redistance.h"
#include "vdbounce/io/openvdb_grid.h"

#include <catch2/catch.hpp>
#include <openvdb/tools/Diagnostics.h>

#include <cmath>

#include <tbb/global_control.h>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

const Vec3d kCentre(0.013, 0.0171, 0.0093); // off the lattice

Phi torus()
{
    return [](const Vec3d& p) {
        const Vec3d q = p - kCentre;
        return std::hypot(std::hypot(q.x(), q.z()) - 0.7, q.y()) - 0.3;
    };
}

ScalarGrid scalar(const openvdb::FloatGrid::Ptr& grid) { return toScalarGrid(openvdb::FloatGrid::ConstPtr(grid)); }

// `change(phi, point)` in place of the active values.
openvdb::FloatGrid::Ptr changed(const openvdb::FloatGrid::Ptr& grid,
                                const std::function<double(double, const Vec3d&)>& change)
{
    const openvdb::FloatGrid::Ptr result = grid->deepCopy();
    for (auto it = result->beginValueOn(); it; ++it) {
        const openvdb::Vec3d p = result->indexToWorld(it.getCoord());
        it.setValue(float(change(*it, Vec3d(p.x(), p.y(), p.z()))));
    }
    return result;
}

RedistanceOptions bands(double exteriorVx, double interiorVx)
{
    RedistanceOptions options;
    options.exterior = Length{exteriorVx, true};
    options.interior = Length{interiorVx, true};
    return options;
}

struct Errors {
    double largestVx = 0.0;
    double meanVx = 0.0;
    std::size_t voxels = 0;
};

Errors errorsOf(const LevelSetGrid& result, const Phi& phi)
{
    const openvdb::FloatGrid& grid = toOpenVdb(result);
    const double unit = std::max({grid.voxelSize()[0], grid.voxelSize()[1], grid.voxelSize()[2]});
    Errors errors;
    for (auto it = grid.cbeginValueOn(); it; ++it) {
        const openvdb::Vec3d p = grid.indexToWorld(it.getCoord());
        const double error = std::abs(*it - phi(Vec3d(p.x(), p.y(), p.z()))) / unit;
        errors.largestVx = std::max(errors.largestVx, error);
        errors.meanVx += error;
        ++errors.voxels;
    }
    errors.meanVx /= double(errors.voxels);
    return errors;
}

// Voxels of [-side, side]^3 of which it is told wrongly, or not, that they are in the band; rounding aside.
std::size_t wrongTopology(const LevelSetGrid& result, const Phi& phi, int side, double exterior, double interior)
{
    const openvdb::FloatGrid& grid = toOpenVdb(result);
    auto accessor = grid.getConstAccessor();
    const double close = 0.01 * grid.voxelSize()[0];
    std::size_t wrong = 0;
    for (int x = -side; x <= side; ++x) {
        for (int y = -side; y <= side; ++y) {
            for (int z = -side; z <= side; ++z) {
                const openvdb::Coord c(x, y, z);
                const openvdb::Vec3d p = grid.indexToWorld(c);
                const double exact = phi(Vec3d(p.x(), p.y(), p.z()));
                if (std::abs(exact - exterior) < close || std::abs(exact + interior) < close) continue;
                const bool within = exact < exterior && exact > -interior;
                const double cut = std::min(std::max(exact, -interior), exterior);
                if (accessor.isValueOn(c) != within || std::abs(accessor.getValue(c) - cut) > close) ++wrong;
            }
        }
    }
    return wrong;
}

bool sameBits(const LevelSetGrid& a, const LevelSetGrid& b)
{
    const openvdb::FloatTree& one = toOpenVdb(a).tree();
    const openvdb::FloatTree& other = toOpenVdb(b).tree();
    if (!one.hasSameTopology(other)) return false;
    auto it = other.cbeginLeaf();
    for (auto leaf = one.cbeginLeaf(); leaf; ++leaf, ++it) {
        if (!(leaf->buffer() == it->buffer())) return false;
    }
    return true;
}

} // namespace

TEST_CASE("redistancing finds the distance to a sphere through any function that has it as its zero")
{
    const openvdb::FloatGrid::Ptr grid = bandGrid(sphere(1.0, kCentre), uniformTransform(1.0 / 16), 24);
    const auto changes = {
        std::function<double(double, const Vec3d&)>([](double phi, const Vec3d&) { return phi; }),
        std::function<double(double, const Vec3d&)>([](double phi, const Vec3d&) { return phi * phi * phi + phi; }),
        std::function<double(double, const Vec3d&)>(
            [](double phi, const Vec3d&) { return 40.0 * (phi * phi + 2.0 * phi); }),
        std::function<double(double, const Vec3d&)>([](double phi, const Vec3d& p) {
            return phi * (1.0 + 0.5 * std::sin(4.0 * p.x()) * std::sin(3.0 * p.y() + 1.0) * std::cos(5.0 * p.z()));
        })};
    for (const auto& change : changes) {
        const LevelSetGrid result = redistance(scalar(changed(grid, change)), bands(3, 3));
        const Errors errors = errorsOf(result, sphere(1.0, kCentre));
        // Largest where the last one's waves, five radians a unit, are 20 voxels long.
        CHECK(errors.largestVx < 6e-3);
        CHECK(errors.meanVx < 4e-4);
        CHECK(double(errors.voxels) == Approx(double(grid->activeVoxelCount())).margin(3)); // at the band's end
        CHECK(openvdb::tools::checkLevelSet(toOpenVdb(result), 8).empty());
    }
}

TEST_CASE("the error of redistancing falls with the fourth power of the voxel")
{
    double before = 0.0;
    for (const int voxels : {6, 12, 24}) {
        const openvdb::FloatGrid::Ptr grid = bandGrid(torus(), uniformTransform(0.3 / voxels), 4 * voxels);
        const double error = errorsOf(redistance(scalar(grid), bands(3, 3)), torus()).meanVx;
        // In voxels, so the third power is left: 8; fewer on the coarsest, where some cells are too bent for a cubic.
        if (before > 0.0) CHECK(error < before / 5.0);
        before = error;
    }
    CHECK(before < 1e-5);
}

TEST_CASE("redistancing a distance leaves it, and the surface, where they are")
{
    const openvdb::FloatGrid::Ptr grid = bandGrid(torus(), uniformTransform(0.025), 48);
    const LevelSetGrid once = redistance(scalar(grid));
    const openvdb::FloatGrid& result = toOpenVdb(once);
    CHECK(result.background() == Approx(grid->background()));
    auto accessor = result.getConstAccessor();
    double change = 0.0;
    double moved = 0.0;
    for (auto it = grid->cbeginValueOn(); it; ++it) {
        change = std::max(change, std::abs(double(*it) - accessor.getValue(it.getCoord())));
        for (int axis = 0; axis < 3; ++axis) {
            openvdb::Coord next = it.getCoord();
            next[axis] += 1;
            const double a = *it;
            const double b = grid->tree().getValue(next);
            const double c = accessor.getValue(it.getCoord());
            const double d = accessor.getValue(next);
            REQUIRE(((a < 0) == (c < 0)));
            if ((a < 0) != (b < 0)) moved = std::max(moved, std::abs(a / (a - b) - c / (c - d)));
        }
    }
    CHECK(change < 1e-3 * 0.025);
    CHECK(moved < 1e-3); // of a voxel
}

TEST_CASE("the band is widened and narrowed on each side by itself")
{
    const openvdb::FloatGrid::Ptr grid = bandGrid(sphere(1.0, kCentre), uniformTransform(1.0 / 16), 24);
    const double voxel = 1.0 / 16;
    const double widths[][2] = {{9, 2}, {1, 1}, {2, 12}, {5, 14}};
    for (const auto& width : widths) {
        const LevelSetGrid result = redistance(scalar(grid), bands(width[0], width[1]));
        INFO(width[0] << " " << width[1]);
        CHECK(wrongTopology(result, sphere(1.0, kCentre), 32, width[0] * voxel, width[1] * voxel) == 0);
        CHECK(toOpenVdb(result).background() == Approx(width[0] * voxel));
    }
}

TEST_CASE("a wide band is exact up to where two parts of the surface are equally near")
{
    const openvdb::FloatGrid::Ptr grid = bandGrid(torus(), uniformTransform(0.04), 30);
    const LevelSetGrid result = redistance(scalar(grid), bands(9, 7));
    CHECK(errorsOf(result, torus()).largestVx < 0.02);
    CHECK(errorsOf(result, torus()).meanVx < 1e-3);
}

TEST_CASE("redistancing measures in space under any linear transform")
{
    Mat3d rows;
    rows << 0.05, 0.01, 0.0, -0.012, 0.06, 0.004, 0.002, 0.015, 0.045; // turned, sheared, sides that differ
    const auto transform = affineTransform(rows, Vec3d(0.3, -0.2, 0.1));
    const Phi ball = sphere(0.8, Vec3d(0.31, -0.22, 0.12));
    const openvdb::FloatGrid::Ptr dense = denseGrid(ball, transform, 32);
    const LevelSetGrid result = redistance(scalar(dense), bands(3, 3));
    const Errors errors = errorsOf(result, ball);
    CHECK(errors.voxels > 10000);
    CHECK(errors.largestVx < 2e-3);
    const double unit = rows.rowwise().norm().maxCoeff();
    CHECK(wrongTopology(result, ball, 28, 3 * unit, 3 * unit) == 0);
}

TEST_CASE("threads and processors do not change a bit of a redistanced grid")
{
    VDBOUNCE_RANDOM(random);
    const openvdb::FloatGrid::Ptr grid = bandGrid(torus(), uniformTransform(0.04), 30);
    for (auto it = grid->beginValueOn(); it; ++it) it.setValue(*it + float(random.uniform(-0.004, 0.004)));
    const LevelSetGrid result = redistance(scalar(grid), bands(6, 4));
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        CHECK(sameBits(result, redistance(scalar(grid), bands(6, 4))));
    }
    for (const std::string& target : vectorTargets()) {
        chooseVectorTarget(target);
        INFO(target);
        CHECK(sameBits(result, redistance(scalar(grid), bands(6, 4))));
    }
    chooseVectorTarget("");
}
