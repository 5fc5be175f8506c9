// SPDX-License-Identifier: Apache-2.0
#include "support/meshes.h"
#include "support/random.h"
#include "support/run_tool.h"
#include "support/temporary_folder.h"

#include "vdbounce/base/error.h"
#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/build/verify_level_set.h"
#include "vdbounce/field/distance_field.h"
#include "vdbounce/io/grid_file.h"
#include "vdbounce/io/mesh_file.h"
#include "vdbounce/io/openvdb_grid.h"

#include <openvdb/tools/Diagnostics.h>
#include <openvdb/tools/LevelSetUtil.h>

#include <tbb/global_control.h>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

MeshToLevelSetOptions withVoxel(double size)
{
    MeshToLevelSetOptions options;
    options.voxelSize = size;
    return options;
}

// Every active voxel against every triangle: distance to a few float ulps, and the sign where it is known.
void requireExact(const MeshToLevelSetResult& result, const TriangleMesh& mesh,
                  const std::function<bool(const Vec3d&)>& inside)
{
    const openvdb::FloatGrid& grid = toOpenVdb(result.grid);
    REQUIRE(grid.activeVoxelCount() > 0);
    for (auto voxel = grid.cbeginValueOn(); voxel; ++voxel) {
        const openvdb::Vec3d w = grid.indexToWorld(voxel.getCoord());
        const Vec3d p(w[0], w[1], w[2]);
        const double distance = bruteForceDistance(mesh, p);
        REQUIRE(std::abs(std::abs(double(*voxel)) - distance) <= 1e-6 * grid.background());
        if (distance > 1e-6 * grid.background()) {
            INFO("at " << p.transpose());
            REQUIRE((*voxel < 0.0f) == inside(p));
        }
    }
}

double phiAt(const MeshToLevelSetResult& result, const Vec3d& p) { return DistanceField(result.grid).phi(p); }

} // namespace

TEST_CASE("a converted mesh holds exact distances in the whole band")
{
    const TriangleMesh ball = sphereMesh(1.0, 2);
    const TriangleMesh box = boxMesh(Vec3d(0.7, 0.4, 0.55), Vec3d(0.1, -3.02, 0.03));
    requireExact(meshToLevelSet(box, withVoxel(0.05)), box, [](const Vec3d& p) {
        return ((p - Vec3d(0.1, -3.02, 0.03)).cwiseAbs() - Vec3d(0.7, 0.4, 0.55)).maxCoeff() < 0;
    });
    MeshToLevelSetOptions wide = withVoxel(0.08);
    wide.exteriorVx = 6.5;
    wide.interiorVx = 2.0;
    const auto result = meshToLevelSet(ball, wide);
    CHECK(toOpenVdb(result.grid).background() == Approx(6.5 * 0.08));
    requireExact(result, ball, [&](const Vec3d& p) { return bruteForceInside(ball, p); });
}

TEST_CASE("every voxel within the band is active and no other")
{
    const TriangleMesh box = boxMesh(Vec3d(0.7, 0.4, 0.55));
    const auto result = meshToLevelSet(box, withVoxel(0.1));
    const openvdb::FloatGrid& grid = toOpenVdb(result.grid);
    const auto accessor = grid.getConstAccessor();
    const double band = 0.3;
    for (int x = -13; x <= 13; ++x) {
        for (int y = -13; y <= 13; ++y) {
            for (int z = -13; z <= 13; ++z) {
                const openvdb::Coord c(x, y, z);
                const double distance = bruteForceDistance(box, 0.1 * Vec3d(x, y, z));
                if (std::abs(distance - band) < 1e-6) continue;
                INFO(c);
                REQUIRE(accessor.isValueOn(c) == (distance < band));
                const bool inside = std::abs(x) < 7 && std::abs(y) < 4 && std::abs(0.1 * z) < 0.55;
                if (distance > 1e-6) REQUIRE((accessor.getValue(c) < 0) == inside);
            }
        }
    }
}

TEST_CASE("the bunny is exact and passes OpenVDB's own check of a level set's band")
{
    const TriangleMesh mesh = readMesh(sourcePath("data/bunny.obj"));
    const auto result = meshToLevelSet(mesh, withVoxel(9.9 / 64));
    CHECK(result.warnings.empty());
    const VerifyReport report = verifyLevelSet(result.grid, mesh, {1000000});
    CHECK(report.samples == toOpenVdb(result.grid).activeVoxelCount());
    CHECK(report.maxErrorVx < 1e-4);
    CHECK(report.signErrors == 0);
    openvdb::tools::CheckLevelSet<openvdb::FloatGrid> check(toOpenVdb(result.grid));
    CHECK(check.checkTransform() == "");
    CHECK(check.checkTiles() == "");
    CHECK(check.checkFinite() == "");
    CHECK(check.checkInactiveValues() == "");
}

TEST_CASE("cavities stay open, overlaps and close neighbours stay right")
{
    const auto shell = meshToLevelSet(joined(sphereMesh(1.0, 4), flipped(sphereMesh(0.5, 4))), withVoxel(0.05));
    CHECK(phiAt(shell, Vec3d(0, 0, 0)) > 0);
    CHECK(phiAt(shell, Vec3d(0.75, 0, 0)) < 0);
    CHECK(phiAt(shell, Vec3d(1.1, 0, 0)) > 0);

    const auto overlap = meshToLevelSet(
        joined(boxMesh(Vec3d(1, 0.5, 0.5)), boxMesh(Vec3d(1, 0.5, 0.5), Vec3d(1, 0.2, 0))), withVoxel(0.1));
    CHECK(phiAt(overlap, Vec3d(0.5, 0.1, 0)) < 0);
    CHECK(phiAt(overlap, Vec3d(-0.8, 0, 0)) < 0);

    for (double voxel : {0.03, 0.05, 0.07, 0.09}) {
        const auto pair = meshToLevelSet(
            joined(boxMesh(Vec3d(0.5, 0.5, 0.5), Vec3d(-0.55, 0, 0)), boxMesh(Vec3d(0.5, 0.5, 0.5), Vec3d(0.55, 0, 0))),
            withVoxel(voxel));
        INFO("a gap of 0.1 at voxel " << voxel);
        CHECK(phiAt(pair, Vec3d(0, 0, 0)) > 0);
    }
}

TEST_CASE("each sign method does what it says")
{
    const TriangleMesh shell = joined(sphereMesh(1.0, 3), flipped(sphereMesh(0.5, 3)));
    const TriangleMesh inward = joined(sphereMesh(1.0, 3), sphereMesh(0.5, 3)); // the inner one faces outwards
    const auto sign = [](const TriangleMesh& mesh, SignMethod method, const Vec3d& p) {
        MeshToLevelSetOptions options = withVoxel(0.08);
        options.sign = method;
        return phiAt(meshToLevelSet(mesh, options), p) < 0 ? -1 : 1;
    };
    const Vec3d centre = Vec3d::Zero();
    const Vec3d wall(0.75, 0, 0);
    CHECK(sign(shell, SignMethod::Winding, centre) == 1);
    CHECK(sign(shell, SignMethod::Parity, centre) == 1);
    CHECK(sign(shell, SignMethod::Flood, centre) == -1); // cavities are filled
    CHECK(sign(inward, SignMethod::Winding, centre) == -1);
    CHECK(sign(inward, SignMethod::Parity, centre) == 1);
    for (SignMethod method : {SignMethod::Winding, SignMethod::Parity, SignMethod::Flood}) {
        CHECK(sign(shell, method, wall) == -1);
        CHECK(sign(shell, method, Vec3d(0, 1.2, 0)) == 1);
    }
}

TEST_CASE("faces that disagree are turned, and small holes change nothing")
{
    TriangleMesh shuffled = sphereMesh(1.0, 3);
    for (std::size_t t = 0; t < shuffled.triangles.size(); t += 2)
        std::swap(shuffled.triangles[t][1], shuffled.triangles[t][2]);
    const auto turned = meshToLevelSet(shuffled, withVoxel(0.1));
    CHECK(turned.sign == SignMethod::Winding);
    REQUIRE(turned.warnings.size() == 1);
    CHECK_THAT(turned.warnings[0], Catch::Contains("oriented opposite"));
    CHECK(phiAt(turned, Vec3d(0, 0.8, 0)) < 0);
    CHECK(phiAt(turned, Vec3d(0, 1.2, 0)) > 0);
    MeshToLevelSetOptions parity = withVoxel(0.1);
    parity.sign = SignMethod::Parity;
    CHECK(phiAt(meshToLevelSet(shuffled, parity), Vec3d(0, 0.8, 0)) < 0);

    TriangleMesh torn = sphereMesh(1.0, 4);
    torn.triangles.erase(torn.triangles.begin() + 100);
    torn.triangles.erase(torn.triangles.begin() + 777);
    const auto result = meshToLevelSet(torn, withVoxel(0.03));
    const VerifyReport report = verifyLevelSet(result.grid, sphereMesh(1.0, 4), {1000000});
    CHECK(report.signErrors <= 40); // of the voxels in the two holes
}

TEST_CASE("a mesh that is inside out is solid all the same")
{
    const TriangleMesh box = flipped(boxMesh(Vec3d(0.5, 0.5, 0.5)));
    const auto result = meshToLevelSet(box, withVoxel(0.1));
    CHECK(phiAt(result, Vec3d::Zero()) < 0);
    CHECK(phiAt(result, Vec3d(0.7, 0, 0)) > 0);
    CHECK(verifyLevelSet(result.grid, box).signErrors == 0);
}

TEST_CASE("an open box does not leak its inside into the space around")
{
    TriangleMesh open = boxMesh(Vec3d(0.5, 0.5, 0.5));
    open.triangles.resize(10);
    const auto result = meshToLevelSet(open, withVoxel(0.05));
    for (double y : {-3.0, 0.0, 3.0}) {
        for (double x : {-3.0, 0.9, 3.0}) CHECK(phiAt(result, Vec3d(x, y, 0.9)) > 0);
    }
    CHECK(phiAt(result, Vec3d(0, 0, -0.3)) < 0);
}

TEST_CASE("what would not fit in memory is refused before any of it is taken")
{
    CHECK_THROWS_WITH(meshToLevelSet(boxMesh(Vec3d(1, 1, 1)), withVoxel(5e-5)), Catch::Contains("would take about"));
    const TriangleMesh stray =
        joined(boxMesh(Vec3d(0.1, 0.1, 0.1)), boxMesh(Vec3d(0.1, 0.1, 0.1), Vec3d::Constant(300)));
    const auto apart = meshToLevelSet(stray, withVoxel(0.005)); // only what is near surfaces costs
    CHECK(phiAt(apart, Vec3d::Constant(300)) < 0);
    CHECK(phiAt(apart, Vec3d::Constant(150)) > 0);
    MeshToLevelSetOptions flood = withVoxel(0.005); // which looks at all space between
    flood.sign = SignMethod::Flood;
    CHECK_THROWS_WITH(meshToLevelSet(stray, flood), Catch::Contains("would take about"));
    MeshToLevelSetOptions little = withVoxel(0.01);
    little.maxMemory = 1000000;
    CHECK_THROWS_WITH(meshToLevelSet(boxMesh(Vec3d(1, 1, 1)), little), Catch::Contains("--max-memory"));
}

TEST_CASE("an open mesh is converted with a warning, and a sheet has its thickness")
{
    TriangleMesh bowl = sphereMesh(1.0, 3);
    bowl.triangles.erase(std::remove_if(bowl.triangles.begin(), bowl.triangles.end(),
                                        [&](const auto& t) { return bowl.points[t[0]].y() > 0.85; }),
                         bowl.triangles.end());
    const auto solid = meshToLevelSet(bowl, withVoxel(0.1));
    REQUIRE(solid.warnings.size() == 2);
    CHECK_THAT(solid.warnings[0], Catch::Contains("open"));
    CHECK_THAT(solid.warnings[1], Catch::Contains("unused"));
    CHECK(phiAt(solid, Vec3d(0, -0.8, 0)) < 0);

    MeshToLevelSetOptions options = withVoxel(0.1);
    options.sign = SignMethod::Unsigned;
    options.thicknessVx = 3.0;
    const auto sheet = meshToLevelSet(bowl, options);
    const openvdb::FloatGrid& grid = toOpenVdb(sheet.grid);
    for (auto voxel = grid.cbeginValueOn(); voxel; ++voxel) {
        const openvdb::Vec3d w = grid.indexToWorld(voxel.getCoord());
        REQUIRE(*voxel == Approx(bruteForceDistance(bowl, Vec3d(w[0], w[1], w[2])) - 0.15).margin(1e-6));
    }
    CHECK(phiAt(sheet, Vec3d(0, 0, 0)) > 0);
}

TEST_CASE("degenerate triangles and a mesh smaller than a voxel do no harm")
{
    TriangleMesh mesh = boxMesh(Vec3d(0.5, 0.5, 0.5));
    mesh.points.emplace_back(0.5, 0.0, 0.0);
    mesh.triangles.push_back({8, 8, 8});
    mesh.triangles.push_back({1, 1, 7});
    const auto result = meshToLevelSet(mesh, withVoxel(0.1));
    CHECK(phiAt(result, Vec3d::Zero()) < 0);
    CHECK(phiAt(result, Vec3d(0.55, 0, 0)) == Approx(0.05).margin(1e-6));
    CHECK(toOpenVdb(meshToLevelSet(boxMesh(Vec3d(0.01, 0.01, 0.01), Vec3d(0.5, 0.5, 0.5)), withVoxel(1.0)).grid)
              .activeVoxelCount() > 0);
}

TEST_CASE("a conversion has the same bits for any number of threads")
{
    const TriangleMesh mesh = readMesh(sourcePath("data/bunny.obj"));
    const TemporaryFolder folder;
    for (std::size_t threads : {1u, 2u, 5u}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        writeLevelSet(meshToLevelSet(mesh, withVoxel(0.12)).grid, folder / (std::to_string(threads) + ".vdb"));
    }
    CHECK(readFile(folder / "1.vdb") == readFile(folder / "2.vdb"));
    CHECK(readFile(folder / "1.vdb") == readFile(folder / "5.vdb"));
}

TEST_CASE("options out of range are refused by name")
{
    const TriangleMesh mesh = boxMesh(Vec3d(1, 1, 1));
    CHECK_THROWS_WITH(meshToLevelSet(mesh, withVoxel(0.0)), Catch::Contains("voxel size"));
    CHECK_THROWS_WITH(meshToLevelSet(mesh, withVoxel(-1.0)), Catch::Contains("voxel size"));
    MeshToLevelSetOptions thin = withVoxel(0.1);
    thin.interiorVx = 0.5;
    CHECK_THROWS_WITH(meshToLevelSet(mesh, thin), Catch::Contains("interior"));
    CHECK_THROWS_WITH(meshToLevelSet(mesh, withVoxel(1e-6)), Catch::Contains("1.5e-5"));
}
