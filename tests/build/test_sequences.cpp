// SPDX-License-Identifier: Apache-2.0
#include "support/meshes.h"
#include "support/run_tool.h"
#include "support/temporary_folder.h"

#include "vdbounce/base/triangle_distance.h"
#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/build/topology_memory.h"
#include "vdbounce/build/velocity_grid.h"
#include "vdbounce/io/grid_file.h"
#include "vdbounce/io/mesh_file.h"
#include "vdbounce/io/openvdb_grid.h"

#include <Eigen/Geometry>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

MeshToLevelSetOptions withVoxel(double size)
{
    MeshToLevelSetOptions options;
    options.voxelSize = size;
    options.closest = true;
    return options;
}

// Bent more and more, so that areas and volumes change.
TriangleMesh bent(TriangleMesh mesh, double amount)
{
    for (Vec3d& p : mesh.points) p.x() += amount * std::sin(2.0 * p.y()) + amount;
    return mesh;
}

TriangleMesh withoutTriangles(TriangleMesh mesh, std::size_t count)
{
    mesh.triangles.resize(mesh.triangles.size() - count);
    return mesh;
}

// Every triangle with points of its own, so that welding has something to do.
TriangleMesh tornApart(const TriangleMesh& mesh)
{
    TriangleMesh torn;
    for (const auto& t : mesh.triangles) {
        const auto first = std::uint32_t(torn.points.size());
        for (std::uint32_t p : t) torn.points.push_back(mesh.points[p]);
        torn.triangles.push_back({first, first + 1, first + 2});
    }
    return torn;
}

std::string bytesOf(const MeshToLevelSetResult& result, const TemporaryFolder& folder)
{
    writeLevelSet(result.grid, folder / "o.vdb", {false, {result.closest}});
    return readFile(folder / "o.vdb");
}

Vec3d velocityAt(const openvdb::Vec3SGrid& grid, const openvdb::Coord& voxel)
{
    const openvdb::Vec3f v = grid.tree().getValue(voxel);
    return Vec3d(v.x(), v.y(), v.z());
}

} // namespace

TEST_CASE("meshes of one sequence give the same bytes as each by itself, and what is known is reused")
{
    const TemporaryFolder folder;
    const TriangleMesh ball = sphereMesh(1.0, 4);
    const TriangleMesh halfTurned = readMesh(sourcePath("tests/data/meshes/reversed-half.off"));
    const std::pair<TriangleMesh, std::size_t> cases[] = {
        {ball, 3}, // and how many of the three frames behind the first find nothing new
        {withoutTriangles(ball, 20), 3},
        {tornApart(ball), 3},
        {joined(ball, boxMesh(Vec3d(0.4, 0.4, 0.4), Vec3d(2, 0, 0))), 3},
        {halfTurned, 0}, // which half is turned depends on their areas
    };
    for (const auto& [mesh, reused] : cases) {
        TopologyMemory memory;
        for (double amount : {0.0, 0.1, 0.15, 0.3}) {
            const TriangleMesh frame = bent(mesh, amount);
            const MeshToLevelSetResult single = meshToLevelSet(frame, withVoxel(0.08));
            const MeshToLevelSetResult next = meshToLevelSet(frame, withVoxel(0.08), memory);
            CHECK(bytesOf(next, folder) == bytesOf(single, folder));
            CHECK(next.warnings == single.warnings);
        }
        CHECK(memory.reused() == reused);
    }
}

TEST_CASE("another mesh, and points that meet or part, are found anew")
{
    const TriangleMesh ball = tornApart(sphereMesh(1.0, 2));
    TriangleMesh parting = ball;
    for (std::size_t corner = 0; corner < 3; ++corner) parting.points[corner] += Vec3d(0.5, 0.5, 0.5);
    const TriangleMesh& parted = parting;
    const TriangleMesh box = boxMesh(Vec3d::Ones());
    TopologyMemory memory;
    for (const TriangleMesh* mesh : {&ball, &parted, &ball, &box, &ball}) {
        const MeshTopology fresh = findTopologyMended(*mesh, 0.001);
        const MeshTopology& known = memory.find(*mesh, 0.001);
        CHECK(known.triangles == fresh.triangles);
        CHECK(known.component == fresh.component);
        CHECK(known.rim.size() == fresh.rim.size());
        CHECK(known.welded == fresh.welded);
        REQUIRE(known.components.size() == fresh.components.size());
        for (std::size_t c = 0; c < fresh.components.size(); ++c) {
            CHECK(known.components[c].area == fresh.components[c].area);
            CHECK(known.components[c].volume == fresh.components[c].volume);
        }
    }
    CHECK(memory.reused() == 0);
}

TEST_CASE("a mesh that moves and turns has the exact velocities at every active voxel")
{
    const TriangleMesh mesh =
        joined(sphereMesh(1.0, 3, Vec3d(0.3, 0, 0)), boxMesh(Vec3d(0.5, 0.2, 0.7), Vec3d(2, 0, 0)));
    const Vec3d drift(0.25, -1.5, 3.0);
    const Vec3d axis = Vec3d(1, 2, -1).normalized();
    const double angle = 0.3;
    const double seconds = 0.125;
    const auto moved = [&](double share) {
        TriangleMesh frame = mesh;
        const Mat3d turn = Eigen::AngleAxisd(share * angle, axis).toRotationMatrix();
        for (Vec3d& p : frame.points) p = turn * p + share * seconds * drift;
        return frame;
    };
    const MeshToLevelSetResult result = meshToLevelSet(mesh, withVoxel(0.1));
    const SidecarGrid velocity =
        velocityGrid(result.closest, mesh, pointVelocities(moved(-1.0), moved(1.0), 2.0 * seconds));
    const auto& grid = dynamic_cast<const openvdb::Vec3SGrid&>(toOpenVdb(velocity));
    const auto& closest = dynamic_cast<const openvdb::Int32Grid&>(toOpenVdb(result.closest));
    CHECK(grid.getName() == "v");
    CHECK(grid.activeVoxelCount() == toOpenVdb(result.grid).activeVoxelCount());
    double worst = 0.0;
    for (auto voxel = toOpenVdb(result.grid).cbeginValueOn(); voxel; ++voxel) {
        REQUIRE(grid.tree().isValueOn(voxel.getCoord()));
        const openvdb::Vec3d w = grid.indexToWorld(voxel.getCoord());
        const auto t = std::size_t(closest.tree().getValue(voxel.getCoord()));
        const Vec3d at =
            closestPointOnTriangle(Vec3d(w.x(), w.y(), w.z()), mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2));
        // Central differences of a rotation: sin(angle) over the time, about the axis.
        const Vec3d exact = drift + std::sin(angle) / seconds * axis.cross(at);
        worst = std::max(worst, (velocityAt(grid, voxel.getCoord()) - exact).norm());
    }
    CHECK(worst < 1e-6 * (drift.norm() + 3.0 * angle / seconds));
}

TEST_CASE("weights of the closest point add up to one and give it back, slivers and points included")
{
    const Vec3d a(0, 0, 0);
    const Vec3d corners[][2] = {{Vec3d(1, 0, 0), Vec3d(0.2, 0.7, 0.1)},
                                {Vec3d(1, 0, 0), Vec3d(0.4, 1e-9, 0)},
                                {Vec3d(1, 0, 0), Vec3d(3, 0, 0)},
                                {a, a}};
    for (const auto& [b, c] : corners) {
        for (const Vec3d& p : {Vec3d(0.3, 0.2, 1), Vec3d(-1, -1, 0), Vec3d(2, 0.1, 0), Vec3d(0.6, -0.3, 0.2)}) {
            const Vec3d weights = closestWeights(p, a, b, c);
            CHECK(weights.sum() == Approx(1.0).margin(1e-15));
            CHECK(weights.minCoeff() >= -1e-15);
            const Vec3d at = weights[0] * a + weights[1] * b + weights[2] * c;
            CHECK((at - closestPointOnTriangle(p, a, b, c)).norm() < 1e-8);
        }
    }
}
