// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/points_around.h"

#include "vdbounce/field/sample_points.h"
#include "vdbounce/field/vector_lookup.h"

#include <cmath>
#include <cstring>
#include <numeric>

#include <tbb/global_control.h>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

std::vector<PointSample> lookUp(const DistanceField& field, const std::vector<Vec3d>& points)
{
    std::vector<PointSample> samples(points.size());
    samplePoints(field, points.data(), points.size(), samples.data());
    return samples;
}

bool sameBits(const std::vector<PointSample>& a, const std::vector<PointSample>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(PointSample)) == 0;
}

// In the band, in tiles, on the box and outside of it.
std::vector<Vec3d> pointsAroundAndBetween(const DistanceField& field, Random& random, std::size_t count)
{
    std::vector<Vec3d> points = pointsAround(field, random, count);
    // Half way between voxels, where both must round to the same side.
    for (int i = 0; i < 1000; ++i) {
        points.push_back(field.transform().toWorld(random.in(boxAround(field)).array().floor() + 0.5));
    }
    return points;
}

// The worst disagreement with the lookup of single points, in units in the last place of the largest voxel value.
double worstUlps(const DistanceField& field, const std::vector<Vec3d>& points)
{
    const std::vector<PointSample> samples = lookUp(field, points);
    double worst = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const FieldSample exact = field.sample(points[i]);
        const double ulp = std::numeric_limits<float>::epsilon() * std::max(field.background(), std::abs(exact.phi));
        worst = std::max(worst, std::abs(samples[i].phi - exact.phi) / ulp);
        for (int axis = 0; axis < 3; ++axis) {
            const double difference = std::abs(double(samples[i].gradient[axis]) - exact.gradient[axis]);
            worst = std::max(worst, difference / (ulp / field.voxelSize()));
        }
    }
    return worst;
}

std::vector<FieldOptions> allOptions()
{
    std::vector<FieldOptions> all;
    for (Lookup lookup : {Lookup::Nearest, Lookup::Trilinear, Lookup::Cubic}) {
        for (Normal normal : {Normal::Central, Normal::Analytic}) {
            for (Storage storage : {Storage::Float, Storage::Half, Storage::Fixed8}) {
                all.push_back({lookup, normal, storage});
            }
        }
    }
    return all;
}

openvdb::math::Transform::Ptr skewed()
{
    Mat3d rows;
    rows << 0.1, 0.02, 0, -0.03, 0.12, 0.04, 0.01, 0, 0.11;
    return affineTransform(rows, Vec3d(3, -2, 1));
}

} // namespace

TEST_CASE("many points at once are looked up as one by one is")
{
    VDBOUNCE_RANDOM(random);
    auto mirrored = affineTransform(Vec3d(-0.1, 0.1, 0.1).asDiagonal(), Vec3d(1e4, 0, 0));
    for (const auto& transform : {uniformTransform(0.1), skewed(), mirrored}) {
        const openvdb::Vec3d middle = transform->indexToWorld(openvdb::Vec3d(0));
        const Phi phi = sphere(1.5, Vec3d(middle[0], middle[1], middle[2]));
        for (const auto& grid : {bandGrid(phi, transform, 24), denseGrid(phi, transform, 14)}) {
            for (const FieldOptions& options : allOptions()) {
                const DistanceField field(levelSet(grid), options);
                INFO("lookup " << int(options.lookup) << ", normal " << int(options.normal) << ", storage "
                               << int(options.storage));
                CHECK(worstUlps(field, pointsAroundAndBetween(field, random, 20003)) <=
                      (options.lookup == Lookup::Cubic ? 16.0 : 8.0));
            }
        }
    }
}

TEST_CASE("lookups of many points have the same bits on any processor, in any order, with any number of threads")
{
    VDBOUNCE_RANDOM(random);
    const LevelSetGrid grid = levelSet(bandGrid(sphere(1.5, Vec3d::Constant(0.02)), skewed(), 30));
    for (const FieldOptions& options : allOptions()) {
        const DistanceField field(grid, options);
        std::vector<Vec3d> points = pointsAroundAndBetween(field, random, 10011);
        const std::vector<PointSample> best = lookUp(field, points);
        for (const std::string& target : vectorTargets()) {
            INFO(target);
            chooseVectorTarget(target);
            const bool same = sameBits(lookUp(field, points), best);
            chooseVectorTarget("");
            CHECK(same);
        }
        {
            const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
            CHECK(sameBits(lookUp(field, points), best));
        }
        std::vector<Vec3d> backwards(points.rbegin(), points.rend());
        std::vector<PointSample> mirrored = lookUp(field, backwards);
        std::reverse(mirrored.begin(), mirrored.end());
        CHECK(sameBits(mirrored, best));
    }
}

TEST_CASE("points that are put in order first give the same bits as those that are not")
{
    VDBOUNCE_RANDOM(random);
    // So many blocks that ordering pays, and points enough for that; then each point by a call of its own.
    const DistanceField field(levelSet(denseGrid(sphere(60.0), uniformTransform(1.0), 88)));
    REQUIRE(field.blocks().values().memoryBytes() > std::size_t(50) << 20);
    std::vector<Vec3d> points(field.blocks().blockCount() * 20);
    for (Vec3d& p : points) p = random.in(field.indexBox());
    const std::vector<PointSample> together = lookUp(field, points);
    for (std::size_t i = 0; i < points.size(); i += 7) {
        PointSample alone;
        samplePoints(field, &points[i], 1, &alone);
        REQUIRE(std::memcmp(&alone, &together[i], sizeof alone) == 0);
    }
}

TEST_CASE("lookups of many points need no directory in one array, no voxels, and no finite points")
{
    auto scattered = openvdb::FloatGrid::create(3.0f);
    scattered->setGridClass(openvdb::GRID_LEVEL_SET);
    const openvdb::Coord places[] = {openvdb::Coord(0, 0, 0), openvdb::Coord(1000000000, -1000000000, 5)};
    for (const auto& place : places) scattered->tree().setValueOn(place, -1.0f);
    CHECK(lookUp(DistanceField(levelSet(scattered)), {Vec3d(1e9, -1e9, 5)})[0].phi == -1.0f);

    auto empty = openvdb::FloatGrid::create(3.0f);
    empty->setGridClass(openvdb::GRID_LEVEL_SET);
    CHECK(lookUp(DistanceField(levelSet(empty)), {Vec3d(1, 2, 3)})[0].phi == 3.0f);
    CHECK(lookUp(DistanceField(levelSet(empty)), {}).empty());

    // One tile that fills a node.
    auto tile = openvdb::FloatGrid::create(3.0f);
    tile->setGridClass(openvdb::GRID_LEVEL_SET);
    tile->fill(openvdb::CoordBBox(openvdb::Coord(0), openvdb::Coord(127)), 3.0f, true);
    const std::vector<PointSample> inTile =
        lookUp(DistanceField(levelSet(tile)), std::vector<Vec3d>(64, Vec3d(9, 9, 9)));
    CHECK(inTile.back().phi == 3.0f);

    const DistanceField field(levelSet(bandGrid(sphere(1.0), uniformTransform(0.1), 16)));
    CHECK(std::isnan(lookUp(field, {Vec3d(std::nan(""), 0, 0)})[0].phi));
    CHECK(std::isnan(lookUp(field, {Vec3d(0, std::numeric_limits<double>::infinity(), 0)})[0].phi));
}
