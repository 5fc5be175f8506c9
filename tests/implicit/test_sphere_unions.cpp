// SPDX-License-Identifier: Apache-2.0
#include "support/random.h"

#include "vdbounce/base/error.h"
#include "vdbounce/field/vector_lookup.h"
#include "vdbounce/implicit/blobs.h"
#include "vdbounce/io/openvdb_grid.h"

#include <catch2/catch.hpp>
#include <openvdb/tools/Diagnostics.h>

#include <cmath>
#include <limits>

#include <tbb/global_control.h>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

constexpr double kVoxel = 0.25;
constexpr std::size_t kChecks = 8; // all but the gradient, which has kinks where spheres meet

Particles particlesOf(const std::vector<Vec3d>& centres, const std::vector<double>& radii)
{
    Particles particles;
    particles.position = centres;
    particles.radius = radii;
    numberInOrder(particles);
    return particles;
}

BlobOptions spheres(double halfWidthVx = 3.0, double voxel = kVoxel)
{
    BlobOptions options;
    options.voxelSize = voxel;
    options.kernel = BlobKernel::Sphere;
    options.halfWidthVx = halfWidthVx;
    return options;
}

double exactPhi(const Particles& particles, const Vec3d& p)
{
    double phi = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < particles.size(); ++i)
        phi = std::min(phi, (particles.position[i] - p).norm() - particles.radius[i]);
    return phi;
}

// Compares every voxel of a box (index space) with the least distance to all spheres. Returns the largest error,
// voxels.
double largestError(const LevelSetGrid& grid, const Particles& particles, const openvdb::CoordBBox& box)
{
    const openvdb::FloatGrid& voxels = toOpenVdb(grid);
    const auto accessor = voxels.getConstAccessor();
    const double width = voxels.background();
    const double voxel = voxels.voxelSize().x();
    double largest = 0.0;
    std::size_t wrongStates = 0;
    for (auto c = box.begin(); c; ++c) {
        const double phi = exactPhi(particles, Vec3d((*c).x(), (*c).y(), (*c).z()) * voxel);
        const double clamped = std::min(std::max(phi, -width), width);
        largest = std::max(largest, std::abs(double(accessor.getValue(*c)) - clamped));
        const bool nearEdge = std::abs(std::abs(phi) - width) < 1e-5 * voxel;
        if (!nearEdge && accessor.isValueOn(*c) != (std::abs(phi) < width)) ++wrongStates;
    }
    CHECK(wrongStates == 0);
    return largest / voxel;
}

Particles randomSpheres(Random& random, std::size_t count, double side, double smallestVx, double largestVx,
                        const Vec3d& centre = Vec3d::Zero())
{
    Box box;
    box.min = centre - Vec3d::Constant(side * kVoxel);
    box.max = centre + Vec3d::Constant(side * kVoxel);
    std::vector<Vec3d> centres;
    std::vector<double> radii;
    for (std::size_t i = 0; i < count; ++i) {
        centres.push_back(random.in(box));
        radii.push_back(kVoxel * random.uniform(smallestVx, largestVx));
    }
    return particlesOf(centres, radii);
}

openvdb::CoordBBox cubeAround(const openvdb::Coord& centre, int side)
{
    return openvdb::CoordBBox(centre.offsetBy(-side), centre.offsetBy(side));
}

bool sameGrids(const LevelSetGrid& a, const LevelSetGrid& b)
{
    const openvdb::FloatGrid& first = toOpenVdb(a);
    const openvdb::FloatGrid& second = toOpenVdb(b);
    if (!first.tree().hasSameTopology(second.tree())) return false;
    const auto accessor = second.getConstAccessor();
    for (auto it = first.cbeginValueAll(); it; ++it) {
        if (accessor.getValue(it.getCoord()) != *it) return false;
    }
    return true;
}

} // namespace

TEST_CASE("one sphere is exact to float at any radius")
{
    const Vec3d centre(0.31, -0.12, 0.07);
    for (double radiusVx : {1.0, 3.7, 15.9, 16.1, 60.0}) {
        const Particles one = particlesOf({centre}, {radiusVx * kVoxel});
        const int side = int(radiusVx) + 6;
        CHECK(largestError(blobs(one, spheres()), one, cubeAround(openvdb::Coord(0), side)) < 1e-6);
    }
}

TEST_CASE("a union of equal spheres is the least of their distances, exact to float")
{
    VDBOUNCE_RANDOM(random);
    for (double radiusVx : {0.8, 2.5, 7.0}) {
        const Particles particles = randomSpheres(random, 80, 25.0, radiusVx, radiusVx);
        // Half a unit in the last place of the widest value, 3.
        CHECK(largestError(blobs(particles, spheres()), particles, cubeAround(openvdb::Coord(0), 36)) < 1.3e-7);
    }
}

TEST_CASE("a union of different spheres is the least of their distances to a millionth of a voxel")
{
    VDBOUNCE_RANDOM(random);
    struct Range {
        double smallest, largest, band;
    };
    for (const Range& range : {Range{0.6, 6.0, 3.0}, Range{1.0, 24.0, 3.0}, Range{17.0, 30.0, 5.5}}) {
        const Particles particles = randomSpheres(random, 60, 24.0, range.smallest, range.largest);
        const LevelSetGrid grid = blobs(particles, spheres(range.band));
        CHECK(largestError(grid, particles, cubeAround(openvdb::Coord(0), 40)) < 2e-6);
        CHECK(openvdb::tools::checkLevelSet(toOpenVdb(grid), kChecks).empty());
    }
}

TEST_CASE("spheres a hundred thousand voxels from the origin lose nothing")
{
    VDBOUNCE_RANDOM(random);
    const openvdb::Coord voxel(100'000, -99'997, 100'003);
    const Vec3d centre = kVoxel * Vec3d(voxel.x(), voxel.y(), voxel.z());
    for (double largest : {2.0, 20.0}) {
        const Particles particles = randomSpheres(random, 30, 10.0, 2.0, largest, centre);
        CHECK(largestError(blobs(particles, spheres()), particles, cubeAround(voxel, 30)) < 2e-6);
    }
}

TEST_CASE("a stray particle and the inside of a large one cost no voxels")
{
    const Particles near = particlesOf({Vec3d::Zero()}, {2.0 * kVoxel});
    const Particles both = particlesOf({Vec3d::Zero(), Vec3d(1e7, -1e7, 3e6)}, {2.0 * kVoxel, 2.0 * kVoxel});
    const auto leaves = [](const Particles& p) { return summarize(blobs(p, spheres())).leaves; };
    CHECK(leaves(both) <= 2 * leaves(near) + 19); // wherever it lies among the leaves

    // The shell of a sphere of 300 voxels is 6 wide; all 8^3 leaves that it passes through hold four times that.
    const Particles large = particlesOf({Vec3d(0.1, 0.1, 0.1)}, {300.0 * kVoxel});
    const LevelSetGrid grid = blobs(large, spheres());
    const double shell = 4.0 * M_PI * 300.0 * 300.0 * 6.0;
    CHECK(double(summarize(grid).activeVoxels) == Approx(shell).epsilon(0.01));
    CHECK(double(summarize(grid).leaves) < 4.0 * shell / 512.0);
    const openvdb::FloatGrid& voxels = toOpenVdb(grid);
    CHECK(voxels.tree().getValue(openvdb::Coord(0)) == -voxels.background());
    CHECK(voxels.tree().getValue(openvdb::Coord(150, 100, -90)) == -voxels.background());
    CHECK(voxels.tree().getValue(openvdb::Coord(310, 0, 0)) == voxels.background());
    CHECK(openvdb::tools::checkLevelSet(voxels).empty());
}

TEST_CASE("unions of spheres have the same bits for any number of threads and any order of particles")
{
    VDBOUNCE_RANDOM(random);
    for (double largest : {1.5, 5.0}) {
        const Particles particles = randomSpheres(random, 30'000, 60.0, 1.5, largest);
        const LevelSetGrid all = blobs(particles, spheres());
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        CHECK(sameGrids(all, blobs(particles, spheres())));
        // Values do not depend on the order where squares are compared in double.
        if (largest > 1.5) continue;
        std::vector<std::size_t> backwards(particles.size());
        for (std::size_t i = 0; i < backwards.size(); ++i) backwards[i] = backwards.size() - 1 - i;
        CHECK(sameGrids(all, blobs(reordered(particles, backwards), spheres())));
    }
}

TEST_CASE("spheres and sums of kernels have the same bits on any processor")
{
    VDBOUNCE_RANDOM(random);
    for (double largest : {2.0, 24.0}) {
        const Particles particles = randomSpheres(random, 50, 25.0, 2.0, largest);
        for (BlobKernel kernel : {BlobKernel::Sphere, BlobKernel::Gaussian, BlobKernel::Compact}) {
            BlobOptions options = spheres();
            options.kernel = kernel;
            const LevelSetGrid best = blobs(particles, options);
            for (const std::string& target : vectorTargets()) {
                INFO(target);
                chooseVectorTarget(target);
                const LevelSetGrid other = blobs(particles, options);
                chooseVectorTarget("");
                CHECK(sameGrids(best, other));
            }
        }
    }
}

TEST_CASE("particles that make no surface are counted")
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    const Particles particles = particlesOf(
        {Vec3d::Zero(), Vec3d(nan, 0, 0), Vec3d(9, 9, 9), Vec3d(8, 8, 8), Vec3d(7, 7, 7), Vec3d(5.1, 5.1, 5.1)},
        {1.0, 1.0, infinity, 0.0, -1.0, 0.2 * kVoxel});
    const BlobResult result = makeBlobs(particles, spheres());
    CHECK(result.particles == 2);
    CHECK(result.notFinite == 2);
    CHECK(result.noRadius == 2);
    CHECK(result.tooSmall == 1); // 0.4 voxels from the next voxel centre along each axis
    CHECK(result.warnings.size() == 3);
    const Particles left = particlesOf({particles.position[0], particles.position[5]}, {1.0, 0.2 * kVoxel});
    CHECK(sameGrids(result.grid, blobs(left, spheres())));

    CHECK_THROWS_AS(blobs(particlesOf({Vec3d::Zero()}, {0.0}), spheres()), InputError);
    CHECK_THROWS_AS(blobs(Particles(), spheres()), InputError);
    CHECK_THROWS_AS(blobs(particlesOf({Vec3d(0.1, 0.1, 0.1)}, {0.01}), spheres()), InputError); // no voxel inside
    CHECK_THROWS_AS(blobs(particlesOf({Vec3d(1e9, 0, 0)}, {1.0}), spheres()), InputError);      // beyond 2^30 voxels
    CHECK_THROWS_AS(blobs(particlesOf({Vec3d::Zero()}, {1e12}), spheres()), InputError);
}

TEST_CASE("options of blobs out of range are refused by name")
{
    const Particles particles = particlesOf({Vec3d::Zero()}, {1.0});
    const auto refused = [&](const char* name, void (*change)(BlobOptions&)) {
        BlobOptions options = spheres();
        change(options);
        CHECK_THROWS_WITH(blobs(particles, options), Catch::StartsWith(name));
        CHECK_THROWS_AS(blobs(particles, options), UsageError);
    };
    refused("voxel size", [](BlobOptions& o) { o.voxelSize = 0.0; });
    refused("voxel size", [](BlobOptions& o) { o.voxelSize = 1e-6; });
    refused("band", [](BlobOptions& o) { o.halfWidthVx = 0.5; });
    refused("strength", [](BlobOptions& o) { o.strength = -1.0; });
    refused("threshold", [](BlobOptions& o) { o.threshold = 0.0; });
    refused("cut-off", [](BlobOptions& o) { o.cutOff = 1.0; });
    refused("radius", [](BlobOptions& o) { o.radius = Length{-1.0, true}; });
    const Particles without = particlesOf({Vec3d::Zero()}, {});
    CHECK_THROWS_AS(blobs(without, spheres()), UsageError);
    BlobOptions given = spheres();
    given.radius = Length{4.0, true};
    CHECK(sameGrids(blobs(without, given), blobs(particlesOf({Vec3d::Zero()}, {4.0 * kVoxel}), spheres())));
}
