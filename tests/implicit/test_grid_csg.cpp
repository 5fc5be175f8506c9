// SPDX-License-Identifier: Apache-2.0
#include "implicit/csg_grids.h"

#include "vdbounce/base/error.h"

#include <openvdb/tools/Composite.h>
#include <openvdb/tools/LevelSetMeasure.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <tbb/global_control.h>

using namespace vdbounce;
using namespace vdbounce::test;
using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::FloatGrid;

namespace {

constexpr CsgOperation kOperations[] = {CsgOperation::Union, CsgOperation::Intersection, CsgOperation::Subtraction};

// Tiles of all levels, leaves and voxels of any value in the band, in no order that a surface would have.
FloatGrid::Ptr patchwork(Random& random, float exterior, float interior)
{
    openvdb::initialize();
    auto grid = FloatGrid::create(exterior);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    const auto place = [&](double reach) {
        return Coord(int(random.uniform(-reach, reach)), int(random.uniform(-reach, reach)),
                     int(random.uniform(-reach, reach)));
    };
    for (int side : {8192, 4096, 1024, 256, 130, 40, 9, 8, 3}) {
        for (int i = 0; i < 3; ++i) {
            // Large ones on whole nodes, or their sides would be millions of leaves.
            const int grain = side >= 4096 ? 4096 : side >= 256 ? 128 : 1;
            const Coord from = place(200.0 + 0.6 * side) & ~(grain - 1);
            const bool inside = random.uniform(0.0, 1.0) < 0.7;
            grid->tree().sparseFill(CoordBBox(from, from.offsetBy(side - 1)), inside ? -interior : exterior, false);
        }
    }
    for (int i = 0; i < 2000; ++i)
        grid->tree().setValueOn(place(60.0), float(random.uniform(-double(interior), double(exterior))));
    return grid;
}

float expected(CsgOperation operation, float a, float b) { return float(combine(operation, double(a), double(b))); }

} // namespace

TEST_CASE("grids are combined voxel by voxel, whatever tiles and leaves meet")
{
    VDBOUNCE_RANDOM(random);
    for (int round = 0; round < 6; ++round) {
        const auto a = patchwork(random, 3.0f, 3.0f);
        const auto b = patchwork(random, 3.0f, 3.0f);
        auto inA = a->getConstAccessor();
        auto inB = b->getConstAccessor();
        for (CsgOperation operation : kOperations) {
            const LevelSetGrid result = made(operation, levelSet(a), levelSet(b));
            auto in = toOpenVdb(result).getConstAccessor();
            std::size_t wrong = 0;
            for (int i = 0; i < 60000; ++i) {
                const double reach = i % 2 == 0 ? 70.0 : 9000.0;
                const Coord voxel(int(random.uniform(-reach, reach)), int(random.uniform(-reach, reach)),
                                  int(random.uniform(-reach, reach)));
                if (in.getValue(voxel) != expected(operation, inA.getValue(voxel), inB.getValue(voxel))) ++wrong;
            }
            CHECK(wrong == 0);
            CHECK(toOpenVdb(result).background() == 3.0f);
        }
    }
}

TEST_CASE("bands of different width are cut to the narrower one, with a note")
{
    VDBOUNCE_RANDOM(random);
    const auto a = patchwork(random, 3.0f, 4.0f);
    const auto b = patchwork(random, 5.0f, 2.0f);
    for (CsgOperation operation : kOperations) {
        const GridCsg result = csg(operation, levelSet(a), levelSet(b));
        const bool turned = operation == CsgOperation::Subtraction;
        const float exterior = turned ? 2.0f : 3.0f;
        const float interior = turned ? 4.0f : 2.0f;
        CHECK(toOpenVdb(result.grid).background() == exterior);
        REQUIRE(result.notes.size() == 1);
        CHECK_THAT(result.notes[0], Catch::Contains("bands of 3vx outside, 4vx inside and 5vx outside, 2vx inside"));
        forEachVoxelWithin(20, [&](const Coord& voxel) {
            const float value = expected(operation, a->tree().getValue(voxel), b->tree().getValue(voxel));
            const float clamped = std::max(-interior, std::min(exterior, value));
            if (valueAt(result.grid, voxel) != clamped) FAIL("value " << valueAt(result.grid, voxel));
            if (value != clamped && toOpenVdb(result.grid).tree().isValueOn(voxel)) FAIL("active beyond the band");
        });
    }
}

TEST_CASE("results are OpenVDB's, value by value and active where its are")
{
    VDBOUNCE_RANDOM(random);
    for (int round = 0; round < 4; ++round) {
        const LevelSetGrid a = randomSolid(random);
        const LevelSetGrid b = randomSolid(random);
        const auto theirs = [&](CsgOperation operation) {
            const FloatGrid& x = toOpenVdb(a);
            const FloatGrid& y = toOpenVdb(b);
            if (operation == CsgOperation::Union) return openvdb::tools::csgUnionCopy(x, y);
            if (operation == CsgOperation::Intersection) return openvdb::tools::csgIntersectionCopy(x, y);
            return openvdb::tools::csgDifferenceCopy(x, y);
        };
        for (CsgOperation operation : kOperations)
            CHECK(differences(made(operation, a, b), levelSet(theirs(operation)), 28) == 0);
    }
}

TEST_CASE("set identities hold to the bit")
{
    VDBOUNCE_RANDOM(random);
    constexpr auto kUnion = CsgOperation::Union;
    constexpr auto kIntersection = CsgOperation::Intersection;
    constexpr auto kSubtraction = CsgOperation::Subtraction;
    for (int round = 0; round < 3; ++round) {
        const LevelSetGrid a = randomSolid(random);
        const LevelSetGrid b = randomSolid(random);
        const LevelSetGrid c = randomSolid(random);
        for (CsgOperation operation : {kUnion, kIntersection}) {
            CHECK(differences(made(operation, a, a), a, 24) == 0);
            CHECK(differences(made(operation, a, b), made(operation, b, a), 24) == 0);
            CHECK(differences(made(operation, made(operation, a, b), c), made(operation, a, made(operation, b, c)),
                              24) == 0);
        }
        CHECK(differences(made(kUnion, a, made(kIntersection, a, b)), a, 24) == 0);
        CHECK(differences(made(kIntersection, a, made(kUnion, a, b)), a, 24) == 0);
        CHECK(differences(made(kIntersection, a, made(kUnion, b, c)),
                          made(kUnion, made(kIntersection, a, b), made(kIntersection, a, c)), 24) == 0);
        // a \ (b u c) = (a \ b) n (a \ c)
        CHECK(differences(made(kSubtraction, a, made(kUnion, b, c)),
                          made(kIntersection, made(kSubtraction, a, b), made(kSubtraction, a, c)), 24) == 0);
        const LevelSetGrid nothing = made(kSubtraction, a, a);
        forEachVoxelWithin(24, [&](const Coord& voxel) {
            if (valueAt(nothing, voxel) < 0.0f) FAIL("something is left of a without a");
        });
    }
}

TEST_CASE("operands far apart stay as they are, and their intersection is empty")
{
    const LevelSetGrid a = bandLevelSet(sphere(8.0), 14);
    const auto moved = toOpenVdb(a).deepCopy();
    openvdb::FloatTree tree(3.0f);
    const Coord far(100000, -70000, 40000);
    for (auto voxel = moved->cbeginValueOn(); voxel; ++voxel) tree.setValueOn(voxel.getCoord() + far, *voxel);
    moved->setTree(std::make_shared<openvdb::FloatTree>(tree));
    const LevelSetGrid b = levelSet(moved);
    const LevelSetGrid both = made(CsgOperation::Union, a, b);
    CHECK(differences(both, a, 20) == 0);
    CHECK(toOpenVdb(both).activeVoxelCount() == 2 * toOpenVdb(a).activeVoxelCount());
    const GridCsg none = csg(CsgOperation::Intersection, a, b);
    CHECK(toOpenVdb(none.grid).tree().root().empty());
    REQUIRE(none.notes.size() == 1);
    CHECK(none.notes[0] == "the result is empty");
}

TEST_CASE("volumes of unions, intersections and differences of spheres are those of lenses")
{
    const double voxel = 0.05;
    const double r = 1.0;
    const double apart = 0.9;
    const auto ball = [&](double x) {
        return levelSet(openvdb::tools::createLevelSetSphere<FloatGrid>(float(r), openvdb::Vec3f(float(x), 0, 0),
                                                                        float(voxel), 3.0f));
    };
    const LevelSetGrid a = ball(0.0);
    const LevelSetGrid b = ball(apart);
    const double lens = M_PI * (4.0 * r + apart) * (2.0 * r - apart) * (2.0 * r - apart) / 12.0;
    const double whole = 4.0 / 3.0 * M_PI * r * r * r;
    const auto volume = [&](CsgOperation operation) {
        return openvdb::tools::levelSetVolume(toOpenVdb(made(operation, a, b)));
    };
    // The volume's own error is a tenth of a per cent on spheres of 20 voxels.
    CHECK(volume(CsgOperation::Union) == Approx(2.0 * whole - lens).epsilon(0.002));
    CHECK(volume(CsgOperation::Intersection) == Approx(lens).epsilon(0.004));
    CHECK(volume(CsgOperation::Subtraction) == Approx(whole - lens).epsilon(0.004));
}

TEST_CASE("csg results are the same for any number of threads, and operands stay as they are")
{
    VDBOUNCE_RANDOM(random);
    const LevelSetGrid a = randomSolid(random);
    const LevelSetGrid b = bandLevelSet(sphere(6.0), 26, 3.0, uniformTransform(0.5));
    const auto before = toOpenVdb(a).deepCopy();
    const LevelSetGrid many = made(CsgOperation::Union, a, b);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const LevelSetGrid alone = made(CsgOperation::Union, a, b);
    CHECK(differences(many, alone, 60) == 0);
    CHECK(toOpenVdb(many).tree().hasSameTopology(toOpenVdb(alone).tree()));
    CHECK(differences(a, levelSet(before), 24) == 0);
}

TEST_CASE("csg refuses what it cannot do")
{
    const LevelSetGrid a = bandLevelSet(sphere(6.0), 12);
    CHECK_THROWS_AS(csg(CsgOperation::Complement, a, a), UsageError);
    GridCsgOptions options;
    for (double blend : {-1.0, std::nan(""), HUGE_VAL}) {
        options.blend = Length{blend, false};
        CHECK_THROWS_AS(csg(CsgOperation::Union, a, a, options), UsageError);
    }
}
