// SPDX-License-Identifier: Apache-2.0
#include "implicit/csg_grids.h"

#include "vdbounce/implicit/redistance.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace vdbounce;
using namespace vdbounce::test;

// Surfaces that pass exactly through voxel centres, where the function is neither positive nor negative.

namespace {

constexpr double kExact = 2e-6; // voxels: floats of up to three

Phi box(const Vec3d& halfSides) { return turnedBox(halfSides, Mat3d::Identity(), Vec3d::Zero()); }

// What CSG makes of planes: the same surface, but no distance beside edges.
Phi planes(const Vec3d& halfSides)
{
    return [halfSides](const Vec3d& p) { return (p.cwiseAbs() - halfSides).maxCoeff(); };
}

LevelSetGrid redistanced(const openvdb::FloatGrid::Ptr& grid, double bandVx = 3.0)
{
    RedistanceOptions options;
    options.exterior = options.interior = Length{bandVx, true};
    return redistance(toScalarGrid(openvdb::FloatGrid::ConstPtr(grid)), options);
}

// Largest errors, voxels.
struct Errors {
    double inside = 0.0;
    double outside = 0.0;
    double onSurface = 0.0; ///< of voxels that the surface passes through
    double away = 0.0;      ///< of voxels whose closest point is two voxels from edges, where `away` told so
    double mean = 0.0;
    std::size_t voxels = 0;
};

Errors errorsOf(const LevelSetGrid& result, const Phi& phi, const std::function<bool(const Vec3d&)>& away = {})
{
    const openvdb::FloatGrid& grid = toOpenVdb(result);
    const double voxel = grid.voxelSize()[0];
    Errors errors;
    for (auto it = grid.cbeginValueOn(); it; ++it) {
        const openvdb::Vec3d w = grid.indexToWorld(it.getCoord());
        const Vec3d p(w.x(), w.y(), w.z());
        const double exact = phi(p) / voxel;
        const double error = std::abs(*it / voxel - exact);
        double& largest = exact < 0.0 ? errors.inside : errors.outside;
        largest = std::max(largest, error);
        if (std::abs(exact) < 1e-9) errors.onSurface = std::max(errors.onSurface, error);
        if (away && away(p)) errors.away = std::max(errors.away, error);
        errors.mean += error;
        ++errors.voxels;
    }
    errors.mean /= double(errors.voxels);
    return errors;
}

// Those of a box from whose surface the closest point is two voxels or more from the nearest edge.
std::function<bool(const Vec3d&)> awayFromEdges(const Vec3d& halfSides, double voxel)
{
    return [=](const Vec3d& p) {
        Vec3d depth = halfSides - p.cwiseAbs();
        std::sort(depth.data(), depth.data() + 3);
        return depth[1] > std::abs(depth[0]) + 2.0 * voxel;
    };
}

} // namespace

TEST_CASE("a box with its faces on voxel centres is measured from its very corners")
{
    for (const double voxel : {1.0, 1.0 / 16, 0.1}) {
        const Vec3d halfSides = voxel * Vec3d(8, 6, 5);
        for (const Phi& phi : {box(halfSides), planes(halfSides)}) {
            INFO(voxel);
            const LevelSetGrid result = redistanced(bandGrid(phi, uniformTransform(voxel), 16));
            const Errors errors = errorsOf(result, box(halfSides), awayFromEdges(halfSides, voxel));
            CHECK(errors.outside < kExact);
            CHECK(errors.onSurface < kExact);
            CHECK(errors.away < kExact);
            CHECK(errors.inside < 0.3); // from there the edges' cells are cut
        }
    }
}

TEST_CASE("edges are off by half a voxel wherever and however they lie in their cells, corners by 0.8")
{
    VDBOUNCE_RANDOM(random);
    for (int i = 0; i < 8; ++i) {
        const Vec3d halfSides(random.uniform(5.0, 9.0), random.uniform(5.0, 9.0), random.uniform(5.0, 9.0));
        const Mat3d axes = i % 4 == 0 ? Mat3d(Mat3d::Identity()) : randomRotation(random);
        const Vec3d centre = random.direction();
        const Phi exact = turnedBox(halfSides, axes, centre);
        const Phi atCentre = planes(halfSides);
        const Phi function = [=](const Vec3d& p) { return atCentre(axes.transpose() * (p - centre)); };
        double edges = 0.0;
        double corners = 0.0;
        const LevelSetGrid result = redistanced(bandGrid(function, uniformTransform(1.0), 20));
        for (auto it = toOpenVdb(result).cbeginValueOn(); it; ++it) {
            const Vec3d p(it.getCoord().x(), it.getCoord().y(), it.getCoord().z());
            Vec3d depth = halfSides - (axes.transpose() * (p - centre)).cwiseAbs();
            std::sort(depth.data(), depth.data() + 3);
            double& largest = depth[2] > std::abs(depth[0]) + 2.0 ? edges : corners;
            largest = std::max(largest, std::abs(*it - exact(p)));
        }
        CHECK(edges < 0.65);
        CHECK(corners < 0.85);
        CHECK(errorsOf(result, exact).mean < 0.06);
    }
}

TEST_CASE("a sphere that passes through voxel centres is measured as any other")
{
    // 13 = |(12, 4, 3)| and |(12, 5, 0)|, 25 = |(24, 7, 0)| = |(20, 12, 9)|, 5 = |(4, 3, 0)|.
    const std::pair<double, double> spheres[] = {{5.0, 2e-3}, {13.0, 5e-4}, {25.0, 1e-4}};
    for (const auto& [radius, allowed] : spheres) {
        INFO(radius);
        const auto grid = bandGrid(sphere(radius), uniformTransform(1.0), int(radius) + 5);
        const Errors errors = errorsOf(redistanced(grid), sphere(radius));
        CHECK(errors.inside < allowed);
        CHECK(errors.outside < allowed);
        CHECK(errors.onSurface < 1e-4);
    }
}

TEST_CASE("planes through voxel centres are exact, and end where the grid does")
{
    for (const Vec3d& normal : {Vec3d(0, 1, 0), Vec3d(1, 1, 0), Vec3d(1, -1, 1)}) {
        INFO(normal.transpose());
        const Phi plane = halfSpace(normal.normalized());
        const Errors errors = errorsOf(redistanced(bandGrid(plane, uniformTransform(1.0), 12)), plane);
        CHECK(errors.voxels > 3000);
        CHECK(std::max(errors.inside, errors.outside) < kExact);
    }
}

TEST_CASE("an edge through voxel centres is exact, and is not made up beyond where the grid ends")
{
    const Phi wedge = [](const Vec3d& p) { return box(Vec3d(20, 20, 1000))(p + Vec3d(20, 20, 0)); };
    const Phi notch = [wedge](const Vec3d& p) { return -wedge(p); };
    for (const Phi& phi : {wedge, notch}) {
        const LevelSetGrid result = redistanced(denseGrid(phi, uniformTransform(1.0), 12));
        double largest = 0.0;
        std::size_t voxels = 0;
        for (auto it = toOpenVdb(result).cbeginValueOn(); it; ++it) {
            const openvdb::Coord c = it.getCoord();
            // On the convex side; on the other the edge's cells are cut.
            const double exact = phi(Vec3d(c.x(), c.y(), c.z()));
            if ((exact < 0.0) == (phi(Vec3d(3, 3, 0)) > 0.0) && exact != 0.0) continue;
            largest = std::max(largest, std::abs(*it - exact));
            ++voxels;
        }
        CHECK(voxels > 1500);
        CHECK(largest < kExact);
    }
}

TEST_CASE("where a function stays zero beyond its surface, the surface is where it starts to")
{
    const Vec3d halfSides(8, 6, 5);
    const Phi exact = box(halfSides);
    for (const double thickness : {0.5, 1.0, 2.0, 100.0}) {
        INFO(thickness);
        const Phi flat = [&](const Vec3d& p) {
            const double phi = exact(p);
            return phi < 0.0 ? phi : std::max(0.0, phi - thickness);
        };
        const openvdb::FloatGrid::Ptr grid = bandGrid(exact, uniformTransform(1.0), 16);
        for (auto it = grid->beginValueOn(); it; ++it) {
            const openvdb::Coord c = it.getCoord();
            it.setValue(float(flat(Vec3d(c.x(), c.y(), c.z()))));
        }
        const Errors errors = errorsOf(redistanced(grid), exact);
        CHECK(errors.outside < kExact);
        CHECK(errors.inside < 0.3);
    }
}

TEST_CASE("a sheet of zeros is a wall within a body and nothing outside one")
{
    const Phi body = box(Vec3d(10, 10, 10));
    const Phi split = [&](const Vec3d& p) { return std::max(body(p), -std::abs(p.z())); };
    const Errors within = errorsOf(redistanced(denseGrid(split, uniformTransform(1.0), 15)), split);
    CHECK(within.onSurface < kExact);
    CHECK(within.outside < kExact);
    CHECK(within.inside < 0.3);

    const Phi ball = sphere(6.3);
    const Phi beside = [&](const Vec3d& p) { return std::min(ball(p), std::abs(p.x() - 8.0)); };
    const Errors without = errorsOf(redistanced(bandGrid(beside, uniformTransform(1.0), 15)), ball);
    // The cells that the sheet's kink is in are known less well.
    CHECK(std::max(without.inside, without.outside) < 0.06);
}
