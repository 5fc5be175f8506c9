// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/blob_surface.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/implicit/ball_descent.h"
#include "vdbounce/implicit/blob_leaves.h"
#include "vdbounce/implicit/kernel_leaf.h"

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

// So many voxels beyond a leaf its neighbours need it, to see how the surface curves.
constexpr double kHaloVx = 2.0;

// Bounds are asked for at cubes of this level and below: larger ones hold too much for one sign, unless balls are few
// and so large that whole cubes are on one side of them.
constexpr int kBoundedLevel = 2;
constexpr std::size_t kFewBalls = 64;

// Bounds are asked for with cells whose diagonal is less than this multiple of the largest radius.
constexpr double kLargestCell = 1.0;

constexpr std::size_t kBallsPerBlock = 65536;

// Within this part of a lone particle's surface the implicit function is straight.
constexpr double kInnermost = 0.25;

double meanRadius(const BallList& balls)
{
    const double sum = reduceBlocks(balls.size(), kBallsPerBlock, 0.0, [&](IndexRange range) {
        double part = 0.0;
        for (std::size_t i = range.begin; i < range.end; ++i) part += balls[i].radius;
        return part;
    });
    return sum / double(balls.size());
}

// What sums become: distance over radius, zero at the surface.
class ImplicitScale {
public:
    ImplicitScale(const BlobSurface& surface, double unit) : kernel_(surface.kernel), unit_(float(unit))
    {
        const double lone = kernelArgument(surface.kernel, surface.level);
        innermost_ = lone > 0.0 ? float(kInnermost * lone) : float(kInnermost);
        atSurface_ = ofSum(float(surface.level));
        farthest_ = ofSum(float(surface.least)) - atSurface_;
    }

    void apply(float* sums) const
    {
        sumsToArguments(kernel_, innermost_, sums);
        for (std::size_t v = 0; v < 512; ++v) sums[v] = unit_ * std::min(sums[v] - atSurface_, farthest_);
    }

    // Outside, where no ball adds anything.
    float background() const { return unit_ * farthest_; }

private:
    float ofSum(float sum) const
    {
        alignas(64) float values[512];
        std::fill_n(values, 512, sum);
        sumsToArguments(kernel_, innermost_, values);
        return values[0];
    }

    BlobKernel kernel_;
    float unit_; // world units at 1
    float innermost_ = 0.0f;
    float atSurface_ = 0.0f;
    float farthest_ = 0.0f; // above atSurface_
};

class BlobWork : public BallWork {
public:
    BlobWork(const BlobSurface& surface, double largestRadius, const ImplicitScale& scale, BlobLeaves& leaves)
        : sum_{surface.kernel, float(surface.least)}, level_(float(surface.level)), largestRadius_(largestRadius),
          scale_(scale), leaves_(leaves)
    {
    }

    bool settled(const LeafCube& cube, const Ball* balls, std::size_t count) override
    {
        if (cube.level > kBoundedLevel && count > kFewBalls) return false;
        Box box = cube.voxels();
        box.min -= Vec3d::Constant(kHaloVx);
        box.max += Vec3d::Constant(kHaloVx);
        // A ball covers no cell that is as large as it.
        const double cell = box.size().norm() / 8.0;
        if (cell < kLargestCell * largestRadius_ && isCovered(balls, count, box, sum_, level_)) {
            leaves_.addInside(cube);
            return true;
        }
        return boundKernels(balls, count, box, sum_).high < level_;
    }

    void leaf(const Vec3i& leaf, const Ball* balls, std::size_t count) override
    {
        alignas(64) float values[512];
        sumKernelsInLeaf(balls, count, leaf, sum_, values);
        scale_.apply(values);
        leaves_.add(leaf, values);
    }

private:
    const KernelSum sum_;
    const float level_;
    const double largestRadius_;
    const ImplicitScale& scale_;
    BlobLeaves& leaves_;
};

} // namespace

std::optional<ScalarGrid> blobImplicit(BallList balls, const BlobSurface& surface, double voxelSize,
                                       std::uint64_t maxLeaves, Progress& progress)
{
    const ImplicitScale scale(surface, meanRadius(balls) * voxelSize);
    double largest = 0.0;
    for (const Ball& ball : balls) largest = std::max(largest, ball.radius);
    BlobLeaves leaves(maxLeaves);
    BlobWork work(surface, largest, scale, leaves);
    const double halo = kHaloVx * std::sqrt(3.0);
    visitLeaves(std::move(balls), {surface.reachPerRadius(), halo}, work, progress);
    return leaves.implicitGrid(scale.background(), voxelSize);
}

} // namespace vdbounce
