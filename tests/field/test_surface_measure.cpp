// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/run_tool.h"

#include "vdbounce/base/error.h"
#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/field/surface_measure.h"
#include "vdbounce/io/mesh_file.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>

#include <tbb/global_control.h>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

constexpr double kPi = 3.14159265358979323846;

SurfaceMeasure measureOf(const openvdb::FloatGrid::Ptr& grid) { return measureSurface(DistanceField(levelSet(grid))); }

SurfaceMeasure measureOf(const Phi& phi, double voxel = 0.05, int side = 24)
{
    return measureOf(bandGrid(phi, uniformTransform(voxel), side));
}

Phi smaller(const Phi& a, const Phi& b)
{
    return [=](const Vec3d& p) { return std::min(a(p), b(p)); };
}

Phi shell(double outer, double inner, const Vec3d& centre)
{
    return [=](const Vec3d& p) { return std::max((p - centre).norm() - outer, inner - (p - centre).norm()); };
}

double ballVolume(double radius) { return 4.0 / 3.0 * kPi * radius * radius * radius; }
double ballArea(double radius) { return 4.0 * kPi * radius * radius; }

} // namespace

TEST_CASE("a ball's volume and area come out with an error of second order")
{
    double coarseVolume = 0.0;
    double coarseArea = 0.0;
    for (const double radiusVx : {7.0, 14.0}) {
        const double voxel = 0.7 / radiusVx;
        const SurfaceMeasure ball = measureOf(sphere(0.7, Vec3d(0.31, 0.17, -0.23) * voxel), voxel, int(radiusVx) + 5);
        CHECK(ball.solids == 1);
        CHECK(ball.cavities == 0);
        CHECK(ball.closed());
        const double volume = 1.0 - ball.volume / ballVolume(0.7);
        const double area = 1.0 - ball.area / ballArea(0.7);
        CHECK(volume * radiusVx * radiusVx == Approx(0.5).margin(0.1));
        CHECK(area * radiusVx * radiusVx == Approx(0.35).margin(0.1));
        if (coarseVolume > 0.0) {
            CHECK(coarseVolume / volume == Approx(4.0).epsilon(0.1));
            CHECK(coarseArea / area == Approx(4.0).epsilon(0.1));
        }
        coarseVolume = volume;
        coarseArea = area;
    }
}

TEST_CASE("a torus and a box have their volume and area")
{
    const SurfaceMeasure torus =
        measureOf([](const Vec3d& p) { return std::hypot(std::hypot(p.x(), p.y()) - 0.6, p.z()) - 0.3; }, 0.025, 40);
    CHECK(torus.volume == Approx(2.0 * kPi * kPi * 0.6 * 0.3 * 0.3).epsilon(0.01));
    CHECK(torus.area == Approx(4.0 * kPi * kPi * 0.6 * 0.3).epsilon(0.01));
    CHECK(torus.pieces.size() == 1);

    // Flat faces are exact; edges are cut off by less than a voxel's square each.
    const Vec3d reach(0.51, 0.33, 0.62);
    const SurfaceMeasure box = measureOf([&](const Vec3d& p) {
        const Vec3d d = p.cwiseAbs() - reach;
        return d.cwiseMax(0.0).norm() + std::min(0.0, d.maxCoeff());
    });
    const double edges = 8.0 * (reach.x() + reach.y() + reach.z());
    CHECK(box.volume < 8.0 * reach.prod());
    CHECK(box.volume > 8.0 * reach.prod() - 0.3 * 0.05 * 0.05 * edges);
    const double area = 8.0 * (reach.x() * reach.y() + reach.y() * reach.z() + reach.z() * reach.x());
    CHECK(box.area < area);
    CHECK(box.area > area - 0.6 * 0.05 * edges);
}

TEST_CASE("solids, cavities and solids in cavities are counted, each with its volume")
{
    const Vec3d centre(0.01, 0.02, 0.03);
    const SurfaceMeasure hollow = measureOf(shell(0.9, 0.5, centre));
    CHECK(hollow.solids == 1);
    CHECK(hollow.cavities == 1);
    CHECK(hollow.volume == Approx(ballVolume(0.9) - ballVolume(0.5)).epsilon(0.01));
    CHECK(hollow.area == Approx(ballArea(0.9) + ballArea(0.5)).epsilon(0.01));

    const SurfaceMeasure nested = measureOf(smaller(shell(0.95, 0.7, centre), sphere(0.3, Vec3d(0.2, 0, 0))));
    CHECK(nested.solids == 2);
    CHECK(nested.cavities == 1);
    REQUIRE(nested.pieces.size() == 3);
    for (const SurfacePiece& piece : nested.pieces) {
        const double away = (piece.place - centre).norm();
        const double expected = piece.volume < 0.0 ? -ballVolume(0.7) : away > 0.8 ? ballVolume(0.95) : ballVolume(0.3);
        CHECK(piece.closed);
        CHECK(piece.volume == Approx(expected).epsilon(0.03));
    }

    VDBOUNCE_RANDOM(random);
    for (int i = 0; i < 20; ++i) {
        // Apart or together by half a voxel.
        const Vec3d away = random.direction();
        for (const double gapVx : {-0.5, 2.0}) {
            const Vec3d offset = (0.5 + 0.5 * gapVx * 0.05) * away;
            const SurfaceMeasure two = measureOf(smaller(sphere(0.5, offset), sphere(0.5, -offset)));
            CHECK(two.solids == (gapVx > 0.0 ? 2u : 1u));
            CHECK(two.volume == Approx(2.0 * ballVolume(0.5)).epsilon(0.02));
        }
    }
}

TEST_CASE("pieces within one cell are told apart")
{
    // Single voxels inside, two cells apart along an axis and one along all three; voxels that share a cell's diagonal
    // hang together only along the one that the cells are split by.
    const auto twoVoxels = [](const openvdb::Coord& other) {
        auto grid = openvdb::FloatGrid::create(3.0f);
        grid->setGridClass(openvdb::GRID_LEVEL_SET);
        auto accessor = grid->getAccessor();
        grid->denseFill(openvdb::CoordBBox(openvdb::Coord(0), openvdb::Coord(14)), 1.0f);
        accessor.setValueOn(openvdb::Coord(7), -1.0f);
        accessor.setValueOn(openvdb::Coord(7) + other, -1.0f);
        return measureOf(grid);
    };
    // An octahedron and more: six tetrahedra around a corner, edges of a half.
    const SurfaceMeasure apart = twoVoxels({-2, -1, 0});
    CHECK(apart.solids == 2);
    CHECK(apart.pieces[0].volume == Approx(apart.pieces[1].volume));
    CHECK(twoVoxels({1, -1, 0}).solids == 2);
    CHECK(twoVoxels({1, 1, 0}).solids == 1);
    CHECK(twoVoxels({1, 1, 1}).solids == 1);
    CHECK(twoVoxels({1, 1, -1}).solids == 2);
    CHECK(twoVoxels({2, 2, 2}).solids == 2);
    CHECK(twoVoxels({1, 0, 0}).solids == 1);
}

TEST_CASE("sheared, mirrored and turned grids measure the same body")
{
    VDBOUNCE_RANDOM(random);
    for (int i = 0; i < 6; ++i) {
        const Mat3d turn = Eigen::Quaterniond::FromTwoVectors(Vec3d::UnitX(), random.direction()).toRotationMatrix();
        Mat3d shear = Mat3d::Identity();
        shear(0, 1) = random.uniform(-0.4, 0.4);
        shear(1, 2) = random.uniform(-0.4, 0.4);
        const Vec3d sides(0.05, random.uniform(0.04, 0.06), random.uniform(-0.06, -0.04));
        const Mat3d rows = sides.asDiagonal() * shear * turn;
        const SurfaceMeasure ball = measureOf(bandGrid(sphere(0.6), affineTransform(rows, Vec3d::Zero()), 24));
        REQUIRE(ball.solids == 1);
        CHECK(ball.cavities == 0);
        CHECK(ball.volume == Approx(ballVolume(0.6)).epsilon(0.015));
        CHECK(ball.area == Approx(ballArea(0.6)).epsilon(0.015));
    }
}

TEST_CASE("a body far from the origin loses no precision")
{
    const auto grid = bandGrid(sphere(0.6, Vec3d(0.01, 0.02, 0.0)), uniformTransform(0.05), 18);
    const SurfaceMeasure near = measureOf(grid);
    auto far = openvdb::FloatGrid::create(grid->background());
    far->setTransform(grid->transform().copy());
    far->setGridClass(openvdb::GRID_LEVEL_SET);
    const openvdb::Coord offset(1 << 28, -(1 << 29), 1 << 30);
    auto accessor = far->getAccessor();
    for (auto it = grid->cbeginValueAll(); it; ++it) {
        if (!it.isVoxelValue()) continue;
        accessor.setValueOnly(it.getCoord() + offset, *it);
        if (it.isValueOn()) accessor.setActiveState(it.getCoord() + offset, true);
    }
    const SurfaceMeasure moved = measureOf(far);
    CHECK(moved.volume == Approx(near.volume).epsilon(1e-13));
    CHECK(moved.area == Approx(near.area).epsilon(1e-13));
    CHECK(moved.pieces.size() == 1);
}

TEST_CASE("a surface that its box cuts off is open, and what is whole beside it is not")
{
    const SurfaceMeasure plane = measureOf(bandGrid(halfSpace(Vec3d(1, 2, 3)), uniformTransform(0.1), 12));
    CHECK_FALSE(plane.closed());
    CHECK(plane.open == 1);
    CHECK(plane.solids == 0);
    CHECK(plane.pieces[0].volume == 0.0);

    // The box from -1.2 to 1.2 cuts a plate's rim off; a ball lies above.
    const double voxel = 0.1;
    const SurfaceMeasure plate = measureOf(
        denseGrid(smaller([](const Vec3d& p) { return std::abs(p.y() + 0.61) - 0.25; }, sphere(0.5, Vec3d(0, 0.6, 0))),
                  uniformTransform(voxel), 12));
    CHECK(plate.open == 2); // its upper and its lower side
    CHECK(plate.solids == 1);
    CHECK(plate.area == Approx(2.0 * 2.4 * 2.4 + ballArea(0.5)).epsilon(0.01));
}

TEST_CASE("a mesh's level set has the mesh's volume")
{
    const TriangleMesh mesh = readMesh(sourcePath("data/bunny.obj"));
    double volume = 0.0;
    double area = 0.0;
    for (const auto& t : mesh.triangles) {
        const Vec3d a = mesh.points[t[0]];
        const Vec3d b = mesh.points[t[1]];
        const Vec3d c = mesh.points[t[2]];
        volume += a.dot(b.cross(c)) / 6.0;
        area += 0.5 * (b - a).cross(c - a).norm();
    }
    MeshToLevelSetOptions options;
    options.voxelSize = 0.0774; // 128 on the longest side
    const SurfaceMeasure bunny = measureSurface(DistanceField(meshToLevelSet(mesh, options).grid));
    CHECK(bunny.solids == 1);
    CHECK(bunny.volume == Approx(volume).epsilon(1e-3));
    CHECK(bunny.area == Approx(area).epsilon(5e-3));
}

TEST_CASE("empty fields have no surface, and coarse storage is refused")
{
    const auto empty = openvdb::FloatGrid::create(0.15f);
    empty->setGridClass(openvdb::GRID_LEVEL_SET);
    CHECK(measureOf(empty).pieces.empty());
    const auto outside = denseGrid([](const Vec3d&) { return 1.0; }, uniformTransform(0.1), 5);
    CHECK(measureOf(outside).pieces.empty());
    FieldOptions options;
    options.storage = Storage::Half;
    const auto ball = bandGrid(sphere(0.5), uniformTransform(0.1), 9);
    CHECK_THROWS_AS(measureSurface(DistanceField(levelSet(ball), options)), UsageError);
}

TEST_CASE("the measure has the same bits for any number of threads")
{
    VDBOUNCE_RANDOM(random);
    const Vec3d wave = 20.0 * random.direction();
    const auto grid = bandGrid(
        [&](const Vec3d& p) {
            return 0.05 * (std::sin(wave.dot(p)) + std::cos(15.0 * p.x()) * std::cos(17.0 * p.z()));
        },
        uniformTransform(0.02), 40);
    const DistanceField field(levelSet(grid));
    const SurfaceMeasure many = measureSurface(field);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    const SurfaceMeasure one = measureSurface(field);
    REQUIRE(one.pieces.size() == many.pieces.size());
    CHECK(one.pieces.size() > 1);
    CHECK(one.area == many.area);
    CHECK(one.volume == many.volume);
    for (std::size_t i = 0; i < one.pieces.size(); ++i) CHECK(one.pieces[i].place == many.pieces[i].place);
}
