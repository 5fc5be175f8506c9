// SPDX-License-Identifier: Apache-2.0
#include "bench/precomputed_gradients.h"
#include "support/grids.h"
#include "support/points_around.h"

#include <cmath>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

// The worst difference to the field's own lookup, in units in the last place of the largest voxel value.
double worstUlps(const DistanceField& field, const std::vector<Vec3d>& points)
{
    std::vector<PointSample> expected(points.size());
    std::vector<PointSample> samples(points.size());
    samplePoints(field, points.data(), points.size(), expected.data());
    bench::PrecomputedGradients(field).sample(points.data(), points.size(), samples.data());
    double worst = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double ulp = double(std::numeric_limits<float>::epsilon()) *
                           std::max(field.background(), std::abs(double(expected[i].phi)));
        worst = std::max(worst, std::abs(double(samples[i].phi) - double(expected[i].phi)) / ulp);
        for (int axis = 0; axis < 3; ++axis) {
            const double difference = std::abs(double(samples[i].gradient[axis]) - double(expected[i].gradient[axis]));
            worst = std::max(worst, difference / (ulp / field.voxelSize()));
        }
    }
    return worst;
}

} // namespace

TEST_CASE("gradients that are stored are those that are computed")
{
    VDBOUNCE_RANDOM(random);
    Mat3d rows;
    rows << 0.1, 0.02, 0, -0.03, 0.12, 0.04, 0.01, 0, 0.11;
    for (const auto& transform : {uniformTransform(0.1), affineTransform(rows, Vec3d(3, -2, 1))}) {
        const openvdb::Vec3d middle = transform->indexToWorld(openvdb::Vec3d(0));
        const Phi phi = sphere(1.5, Vec3d(middle[0], middle[1], middle[2]));
        for (const auto& grid : {bandGrid(phi, transform, 24), denseGrid(phi, transform, 14)}) {
            const DistanceField field(levelSet(grid));
            CHECK(worstUlps(field, pointsAround(field, random, 20003)) <= 8.0);
        }
    }
}

TEST_CASE("gradients that are stored need no blocks")
{
    auto empty = openvdb::FloatGrid::create(3.0f);
    empty->setGridClass(openvdb::GRID_LEVEL_SET);
    CHECK(worstUlps(DistanceField(levelSet(empty)), {Vec3d(1, 2, 3)}) == 0.0);
    auto tile = openvdb::FloatGrid::create(3.0f);
    tile->setGridClass(openvdb::GRID_LEVEL_SET);
    tile->fill(openvdb::CoordBBox(openvdb::Coord(0), openvdb::Coord(127)), 3.0f, true);
    CHECK(worstUlps(DistanceField(levelSet(tile)), std::vector<Vec3d>(64, Vec3d(9, 9, 9))) == 0.0);
}
