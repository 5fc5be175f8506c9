// SPDX-License-Identifier: Apache-2.0
#include "support/random.h"

#include "vdbounce/base/error.h"
#include "vdbounce/field/distance_field.h"
#include "vdbounce/implicit/blobs.h"
#include "vdbounce/implicit/kernel_leaf.h"
#include "vdbounce/io/openvdb_grid.h"

#include <catch2/catch.hpp>
#include <openvdb/tools/Diagnostics.h>

#include <cmath>

#include <tbb/global_control.h>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

constexpr double kVoxel = 0.1;
constexpr std::size_t kChecks = 8; // all but the gradient, which has kinks where surfaces meet

Particles particlesOf(const std::vector<Vec3d>& centres, double radius)
{
    Particles particles;
    particles.position = centres;
    particles.radius.assign(centres.size(), radius);
    numberInOrder(particles);
    return particles;
}

BlobOptions optionsFor(BlobKernel kernel)
{
    BlobOptions options;
    options.voxelSize = kVoxel;
    options.kernel = kernel;
    return options;
}

// F in double, with nothing left out.
double exactSum(const Particles& particles, BlobKernel kernel, const Vec3d& p)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i)
        sum += kernelValue(kernel, (particles.position[i] - p).norm() / particles.radius[i]);
    return sum;
}

std::vector<Ball> randomBalls(Random& random, std::size_t count)
{
    std::vector<Ball> balls;
    for (std::size_t i = 0; i < count; ++i) {
        balls.push_back({random.uniform(-6.0, 14.0), random.uniform(-6.0, 14.0), random.uniform(-6.0, 14.0),
                         random.uniform(0.5, 5.0)});
    }
    return balls;
}

Particles cloud(Random& random, std::size_t count, double side, double radiusVx)
{
    std::vector<Vec3d> centres;
    Box box;
    box.min = Vec3d::Constant(-side * kVoxel);
    box.max = Vec3d::Constant(side * kVoxel);
    for (std::size_t i = 0; i < count; ++i) centres.push_back(random.in(box));
    return particlesOf(centres, radiusVx * kVoxel);
}

} // namespace

TEST_CASE("kernels are one at the centre, fall, and know where they have a value")
{
    for (BlobKernel kernel : {BlobKernel::Gaussian, BlobKernel::Compact}) {
        CHECK(kernelValue(kernel, 0.0) == 1.0);
        for (double x = 0.1; x < 1.95; x += 0.1) {
            CHECK(kernelValue(kernel, x) < kernelValue(kernel, x - 0.1));
            CHECK(kernelArgument(kernel, kernelValue(kernel, x)) == Approx(x));
        }
        CHECK(kernelArgument(kernel, 1.5) == 0.0);
    }
    CHECK(kernelValue(BlobKernel::Gaussian, 1.0) == Approx(std::exp(-1.0)));
    CHECK(kernelValue(BlobKernel::Compact, 1.0) == Approx(27.0 / 64.0));
    CHECK(kernelValue(BlobKernel::Compact, 2.0) == 0.0);
}

TEST_CASE("sums of kernels in a leaf are those of brute force in double, but for what is cut off")
{
    VDBOUNCE_RANDOM(random);
    for (BlobKernel kernel : {BlobKernel::Gaussian, BlobKernel::Compact}) {
        for (float least : {1e-2f, 1e-6f}) {
            const std::vector<Ball> balls = randomBalls(random, 100);
            float values[512];
            sumKernelsInLeaf(balls.data(), balls.size(), Vec3i::Zero(), {kernel, least}, values);
            double low = 1e30;
            double high = 0.0;
            for (int v = 0; v < 512; ++v) {
                double sum = 0.0;
                double cut = 0.0;
                for (const Ball& ball : balls) {
                    const Vec3d offset(ball.x - (v >> 6), ball.y - (v >> 3 & 7), ball.z - (v & 7));
                    const double value = kernelValue(kernel, offset.norm() / ball.radius);
                    (value < double(least) ? cut : sum) += value;
                }
                // One that is as good as the least may fall on either side.
                REQUIRE(std::abs(double(values[v]) - sum) < 1e-5 * sum + 1.01 * double(least));
                REQUIRE(double(values[v]) <= (sum + cut) * (1.0 + 1e-5));
                low = std::min(low, sum);
                high = std::max(high, sum + cut);
            }
            Box box;
            box.min = Vec3d::Zero();
            box.max = Vec3d::Constant(7.0);
            const SumBounds bounds = boundKernels(balls.data(), balls.size(), box, {kernel, least});
            CHECK(double(bounds.low) <= low);
            CHECK(double(bounds.high) >= high);
            // And they say something.
            const Ball one{3.0, 4.0, 3.0, 6.0};
            const SumBounds ofOne = boundKernels(&one, 1, box, {kernel, least});
            CHECK(double(ofOne.high) == Approx(1.0).epsilon(1e-3));
            CHECK(double(ofOne.low) ==
                  Approx(kernelValue(kernel, std::sqrt(4.0 * 4.0 * 3.0) / 6.0)).epsilon(1e-3)); // from (7, 0, 7)
        }
    }
}

TEST_CASE("sums become the distance over the radius of a kernel alone, and go on falling where they are larger")
{
    for (BlobKernel kernel : {BlobKernel::Gaussian, BlobKernel::Compact}) {
        float values[512];
        for (int v = 0; v < 512; ++v) values[v] = float(kernelValue(kernel, 0.5 + 1.4 * v / 511.0));
        sumsToArguments(kernel, 0.5f, values);
        for (int v = 0; v < 512; ++v) REQUIRE(double(values[v]) == Approx(0.5 + 1.4 * v / 511.0).epsilon(1e-5));
        for (int v = 0; v < 512; ++v) values[v] = 0.01f * float(std::exp(0.02 * v)); // up to 275
        sumsToArguments(kernel, 0.5f, values);
        for (int v = 1; v < 512; ++v) REQUIRE(values[v] < values[v - 1]);
    }
}

TEST_CASE("the surface of a blob alone lies where its kernel is the threshold over the strength")
{
    struct Case {
        BlobKernel kernel;
        std::optional<double> threshold;
        double strength;
        double radiusVx;
        double expected; // of the surface, over the radius
    };
    const Case cases[] = {
        {BlobKernel::Gaussian, std::nullopt, 1.0, 8.0, 1.0},
        {BlobKernel::Gaussian, 0.2, 1.0, 8.0, std::sqrt(std::log(5.0))},
        {BlobKernel::Gaussian, 0.5, 3.0, 6.0, std::sqrt(std::log(6.0))},
        {BlobKernel::Compact, std::nullopt, 1.0, 8.0, 1.0},
        {BlobKernel::Compact, 0.125, 1.0, 8.0, std::sqrt(2.0)},
        {BlobKernel::Compact, 0.25, 2.0, 6.0, std::sqrt(2.0)},
        {BlobKernel::Gaussian, std::nullopt, 1.0, 2.5, 1.0},
    };
    const Vec3d centre(0.013, -0.021, 0.037);
    for (const Case& one : cases) {
        BlobOptions options = optionsFor(one.kernel);
        options.threshold = one.threshold;
        options.strength = one.strength;
        const LevelSetGrid grid = blobs(particlesOf({centre}, one.radiusVx * kVoxel), options);
        const openvdb::FloatGrid& voxels = toOpenVdb(grid);
        CHECK(openvdb::tools::checkLevelSet(voxels, kChecks).empty());
        CHECK(voxels.activeVoxelCount() > 100);
        const double radius = one.expected * one.radiusVx * kVoxel;
        double largest = 0.0;
        for (auto it = voxels.cbeginValueOn(); it; ++it) {
            const openvdb::Vec3d p = voxels.indexToWorld(it.getCoord());
            const double exact = (Vec3d(p.x(), p.y(), p.z()) - centre).norm() - radius;
            if (std::abs(exact) > 2.0 * kVoxel) continue; // the surface, rather than what redistancing makes of it
            largest = std::max(largest, std::abs(double(*it) - exact));
        }
        INFO("radius " << one.radiusVx << " voxels, threshold " << one.threshold.value_or(-1.0));
        CHECK(largest / kVoxel < (one.radiusVx > 5.0 ? 0.005 : 0.15));
    }
}

TEST_CASE("two blobs meet where the sum of both is the threshold")
{
    for (BlobKernel kernel : {BlobKernel::Gaussian, BlobKernel::Compact}) {
        const double radius = 8.0 * kVoxel;
        const Particles two = particlesOf({Vec3d(-radius, 0.02, 0.0), Vec3d(radius, 0.02, 0.0)}, radius);
        const DistanceField field(blobs(two, optionsFor(kernel)));
        const double threshold = kernelValue(kernel, 1.0);
        // Along the axis through both, and across it half way between them, where one alone adds no more than t.
        for (const Vec3d& direction : {Vec3d(1, 0, 0), Vec3d(0, 1, 0)}) {
            const Vec3d from(0.0, 0.02, 0.0);
            double inside = direction.x() * radius;
            double outside = 3.0 * radius;
            for (int i = 0; i < 60; ++i) {
                const double middle = 0.5 * (inside + outside);
                (exactSum(two, kernel, from + middle * direction) > threshold ? inside : outside) = middle;
            }
            REQUIRE(inside > 0.2 * radius);
            CHECK(std::abs(field.phi(from + inside * direction)) / kVoxel < 0.03);
        }
        CHECK(field.phi(Vec3d(0.0, 0.02, 0.0)) < 0.0);
    }
}

TEST_CASE("every voxel's side is that of the sum by brute force, in the thick of a cloud too")
{
    VDBOUNCE_RANDOM(random);
    for (BlobKernel kernel : {BlobKernel::Gaussian, BlobKernel::Compact}) {
        for (double radiusVx : {2.0, 6.0}) {
            const Particles particles = cloud(random, 400, 14.0, radiusVx);
            const LevelSetGrid grid = blobs(particles, optionsFor(kernel));
            CHECK(openvdb::tools::checkLevelSet(toOpenVdb(grid), kChecks).empty());
            const auto accessor = toOpenVdb(grid).getConstAccessor();
            const double threshold = kernelValue(kernel, 1.0);
            std::size_t wrong = 0;
            std::size_t inside = 0;
            for (auto c = openvdb::CoordBBox(openvdb::Coord(-30), openvdb::Coord(30)).begin(); c; ++c) {
                if (((*c).x() + (*c).y() + (*c).z()) % 3 != 0) continue; // a third will do
                const double f = exactSum(particles, kernel, kVoxel * Vec3d((*c).x(), (*c).y(), (*c).z())) - threshold;
                if (std::abs(f) < 0.02 * threshold) continue; // what is cut off, and rounding
                inside += f > 0.0 ? 1 : 0;
                wrong += (accessor.getValue(*c) < 0.0f) != (f > 0.0) ? 1 : 0;
            }
            CHECK(wrong == 0);
            CHECK(inside > 1000);
        }
    }
}

TEST_CASE("blobs have the same bits for any number of threads")
{
    VDBOUNCE_RANDOM(random);
    const Particles particles = cloud(random, 5'000, 25.0, 2.0);
    for (BlobKernel kernel : {BlobKernel::Gaussian, BlobKernel::Compact}) {
        const LevelSetGrid all = blobs(particles, optionsFor(kernel));
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        const LevelSetGrid serial = blobs(particles, optionsFor(kernel));
        REQUIRE(toOpenVdb(all).tree().hasSameTopology(toOpenVdb(serial).tree()));
        const auto accessor = toOpenVdb(serial).getConstAccessor();
        std::size_t different = 0;
        for (auto it = toOpenVdb(all).cbeginValueAll(); it; ++it)
            different += accessor.getValue(it.getCoord()) != *it ? 1 : 0;
        CHECK(different == 0);
    }
}

TEST_CASE("blobs that no voxel centre lies in are refused")
{
    const Particles tiny = particlesOf({Vec3d(0.05, 0.05, 0.05)}, 0.2 * kVoxel);
    for (BlobKernel kernel : {BlobKernel::Gaussian, BlobKernel::Compact})
        CHECK_THROWS_AS(blobs(tiny, optionsFor(kernel)), InputError);
    BlobOptions high = optionsFor(BlobKernel::Gaussian);
    high.threshold = 1.5; // more than one particle ever adds
    CHECK_THROWS_AS(blobs(particlesOf({Vec3d::Zero()}, 1.0), high), InputError);
    // But two do, and there are voxels without one of their own.
    const BlobResult two = makeBlobs(particlesOf({Vec3d::Zero(), Vec3d(0.1, 0.0, 0.0)}, 1.0), high);
    CHECK(two.tooSmall == 2);
    CHECK(summarize(two.grid).activeVoxels > 100);
}
