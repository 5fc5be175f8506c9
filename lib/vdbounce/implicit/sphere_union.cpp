// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/sphere_union.h"

#include "vdbounce/implicit/ball_descent.h"
#include "vdbounce/implicit/leaf_collector.h"

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

class SphereWork : public BallWork {
public:
    SphereWork(const SphereBand& band, double largestRadius, LeafCollector& leaves)
        : band_(band), largestRadius_(largestRadius), leaves_(leaves)
    {
    }

    // Deeper inside of one sphere than the band.
    bool settled(const LeafCube& cube, const Ball* balls, std::size_t count) override
    {
        const Box box = cube.voxels();
        const Vec3d centre = box.centre();
        const Vec3d half = 0.5 * box.size();
        const double smallest = half.norm() + band_.halfWidthVx; // of spheres that can hold it
        if (largestRadius_ < smallest) return false;
        const bool within = std::any_of(balls, balls + count, [&](const Ball& ball) {
            if (ball.radius < smallest) return false;
            const Vec3d offset = (Vec3d(ball.x, ball.y, ball.z) - centre).cwiseAbs() + half;
            return offset.norm() <= ball.radius - band_.halfWidthVx;
        });
        if (within) leaves_.addInside(cube);
        return within;
    }

    void leaf(const Vec3i& leaf, const Ball* balls, std::size_t count) override
    {
        SphereLeaf measured;
        measureSphereLeaf(balls, count, leaf, band_, measured);
        if (measured.anyActive()) {
            leaves_.add(leaf, measured.phi, measured.active);
        } else if (measured.phi[0] < 0.0f) {
            leaves_.addInside({leaf, 0});
        }
    }

private:
    const SphereBand band_;
    const double largestRadius_;
    LeafCollector& leaves_;
};

} // namespace

LevelSetGrid sphereUnion(BallList balls, const SphereBand& band, const std::string& name, std::uint64_t maxLeaves,
                         Progress& progress)
{
    double largest = 0.0;
    for (const Ball& ball : balls) largest = std::max(largest, ball.radius);
    LeafCollector leaves(maxLeaves);
    SphereWork work(band, largest, leaves);
    visitLeaves(std::move(balls), {1.0, band.halfWidthVx}, work, progress);
    return leaves.levelSet(band.width(), band.voxelSize, name);
}

} // namespace vdbounce
