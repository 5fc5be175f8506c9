// SPDX-License-Identifier: Apache-2.0
#include "implicit/csg_grids.h"
#include "support/temporary_folder.h"

#include "vdbounce/base/error.h"
#include "vdbounce/field/distance_field.h"
#include "vdbounce/field/sample_points.h"
#include "vdbounce/io/grid_file.h"

#include <openvdb/tools/Diagnostics.h>

using namespace vdbounce;
using namespace vdbounce::test;
using openvdb::Coord;

namespace {

LevelSetGrid complementOf(const LevelSetGrid& a) { return complement(a).grid; }

// Voxels of a's band at which two grids differ.
std::size_t differencesInBand(const LevelSetGrid& a, const LevelSetGrid& b, const LevelSetGrid& band)
{
    std::size_t count = 0;
    for (auto voxel = toOpenVdb(band).cbeginValueOn(); voxel; ++voxel) {
        if (valueAt(a, voxel.getCoord()) != valueAt(b, voxel.getCoord())) ++count;
    }
    return count;
}

} // namespace

TEST_CASE("a complement's phi is the negative, inside without end, in the lookup of one point and of many")
{
    VDBOUNCE_RANDOM(random);
    for (int round = 0; round < 4; ++round) {
        const LevelSetGrid a = randomSolid(random);
        const LevelSetGrid b = complementOf(a);
        const DistanceField fieldA(a);
        const DistanceField fieldB(b);
        CHECK(fieldA.indexBox().min == fieldB.indexBox().min);
        CHECK(fieldA.indexBox().max == fieldB.indexBox().max);
        const Box near{Vec3d::Constant(-18.0), Vec3d::Constant(18.0)};
        const Box far{Vec3d::Constant(-300.0), Vec3d::Constant(300.0)};
        std::vector<Vec3d> points;
        for (int i = 0; i < 4000; ++i) points.push_back(random.in(i % 2 == 0 ? near : far));
        points.push_back(Vec3d(1e7, -1e6, 3.0));
        std::vector<PointSample> samples(points.size());
        samplePoints(fieldB, points.data(), points.size(), samples.data());
        for (std::size_t i = 0; i < points.size(); ++i) {
            const FieldSample inA = fieldA.sample(points[i]);
            const FieldSample inB = fieldB.sample(points[i]);
            CHECK(inB.phi == -inA.phi);
            CHECK(inB.gradient == -inA.gradient);
            CHECK(double(samples[i].phi) == Approx(inB.phi).margin(1e-5));
        }
        CHECK(fieldB.phi(Vec3d(0.0, 1000.0, 0.0)) < -900.0);
    }
}

TEST_CASE("the complement of a complement is the grid that it was")
{
    VDBOUNCE_RANDOM(random);
    const LevelSetGrid a = randomSolid(random);
    CHECK(differences(complementOf(complementOf(a)), a, 60) == 0);
    const LevelSetGrid uneven = bandLevelSet(sphere(9.0), 16, 4.0);
    const LevelSetGrid ball = bandLevelSet(sphere(5.0), 16, 3.0); // the narrower band is the union's
    const LevelSetGrid thin = made(CsgOperation::Union, uneven, ball);
    CHECK(differences(complementOf(complementOf(thin)), thin, 60) == 0);
}

TEST_CASE("De Morgan's laws hold to the bit, also where operands reach beyond each other's boxes")
{
    VDBOUNCE_RANDOM(random);
    for (int round = 0; round < 4; ++round) {
        const LevelSetGrid a = randomSolid(random);
        const Vec3d aside = 40.0 * random.direction();
        const LevelSetGrid b = round % 2 == 0 ? randomSolid(random) : bandLevelSet(sphere(6.0, aside), 52);
        const LevelSetGrid notA = complementOf(a);
        const LevelSetGrid notB = complementOf(b);
        const LevelSetGrid either = made(CsgOperation::Union, a, b);
        const LevelSetGrid both = made(CsgOperation::Intersection, a, b);
        const LevelSetGrid neither = made(CsgOperation::Intersection, notA, notB);
        const LevelSetGrid notBoth = made(CsgOperation::Union, notA, notB);
        CHECK(differences(complementOf(either), neither, 52) == 0);
        if (toOpenVdb(both).activeVoxelCount() > 0) CHECK(differencesInBand(complementOf(both), notBoth, both) == 0);
        CHECK(differences(complementOf(neither), either, 52) == 0);
        // a without b is a and not b.
        CHECK(differences(made(CsgOperation::Subtraction, a, b), made(CsgOperation::Intersection, a, notB), 52) == 0);
        CHECK(differences(made(CsgOperation::Subtraction, a, notB), both, 52) == 0);
    }
}

TEST_CASE("complements are read back from a file without end")
{
    VDBOUNCE_RANDOM(random);
    const TemporaryFolder folder;
    const LevelSetGrid a = bandLevelSet(sphere(6.0), 12);
    const LevelSetGrid ball = bandLevelSet(sphere(6.0, Vec3d(30, 0, 0)), 40);
    writeLevelSet(complementOf(a), folder / "not_a.vdb");
    const LevelSetGrid read = readLevelSet(folder / "not_a.vdb");
    CHECK(differences(read, complementOf(a), 40) == 0);
    CHECK(differences(made(CsgOperation::Intersection, ball, read), ball, 44) == 0);
    CHECK(differences(complementOf(read), a, 40) == 0);
}

TEST_CASE("complements are resampled without end")
{
    const LevelSetGrid hollow = complementOf(bandLevelSet(sphere(6.0), 12));
    const LevelSetGrid ball = bandLevelSet(sphere(5.0, Vec3d(30, 0, 0)), 80, 3.0, uniformTransform(0.5));
    const LevelSetGrid same = made(CsgOperation::Intersection, ball, hollow);
    CHECK(differences(same, ball, 80) == 0);
    const DistanceField field(made(CsgOperation::Union, ball, hollow));
    CHECK(field.phi(Vec3d(0, 0, 0)) > 0.0);
    for (double x : {8.0, 20.0, 30.0, 100.0, 1e5}) CHECK(field.phi(Vec3d(x, 1.0, 0.0)) < 0.0);
}

TEST_CASE("a complement of nothing is refused")
{
    openvdb::initialize();
    const auto empty = openvdb::FloatGrid::create(3.0f);
    empty->setGridClass(openvdb::GRID_LEVEL_SET);
    CHECK_THROWS_AS(complement(levelSet(empty)), InputError);
}

TEST_CASE("OpenVDB's checkLevelSet accepts unions, intersections and differences")
{
    const LevelSetGrid a = bandLevelSet(sphere(9.0), 24);
    const LevelSetGrid b =
        bandLevelSet(turnedBox(Vec3d(5, 7, 6), Eigen::AngleAxisd(0.4, Vec3d(0, 1, 0)).matrix(), Vec3d(8, 2, 1)), 24);
    REQUIRE(openvdb::tools::checkLevelSet(toOpenVdb(a), 5).empty());
    for (CsgOperation operation : {CsgOperation::Union, CsgOperation::Intersection, CsgOperation::Subtraction}) {
        // All but the unit gradient (the ninth), which edges do not have.
        CHECK(openvdb::tools::checkLevelSet(toOpenVdb(made(operation, a, b)), 8) == "");
    }
}
