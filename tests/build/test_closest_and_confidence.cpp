// SPDX-License-Identifier: Apache-2.0
#include "support/meshes.h"
#include "support/random.h"

#include "vdbounce/base/triangle_distance.h"
#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/io/openvdb_grid.h"

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

MeshToLevelSetOptions withVoxel(double size)
{
    MeshToLevelSetOptions options;
    options.voxelSize = size;
    return options;
}

const openvdb::FloatGrid& floats(const SidecarGrid& grid)
{
    return dynamic_cast<const openvdb::FloatGrid&>(toOpenVdb(grid));
}

// Two balls that overlap, one with a hole, a cloth beside them.
TriangleMesh mixedMesh(Random& random)
{
    TriangleMesh torn = boxMesh(Vec3d(0.5, 0.5, 0.5), Vec3d(3, 0, 0));
    torn.triangles.pop_back();
    TriangleMesh cloth;
    for (int i = 0; i <= 10; ++i) {
        for (int j = 0; j <= 10; ++j) cloth.points.emplace_back(0.2 * i, -3.0 + 0.05 * random.uniform(-1, 1), 0.2 * j);
    }
    for (std::uint32_t i = 0; i < 10; ++i) {
        for (std::uint32_t j = 0; j < 10; ++j) {
            const std::uint32_t a = 11 * i + j;
            cloth.triangles.push_back({a, a + 11, a + 12});
            cloth.triangles.push_back({a, a + 12, a + 1});
        }
    }
    return joined(joined(joined(sphereMesh(1.0, 3), sphereMesh(0.6, 3, Vec3d(1, 0.2, 0.1))), torn), cloth);
}

double distanceTo(const TriangleMesh& mesh, std::size_t t, const Vec3d& p)
{
    return (closestPointOnTriangle(p, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)) - p).norm();
}

void requireSameLevelSets(const MeshToLevelSetResult& a, const MeshToLevelSetResult& b)
{
    const openvdb::FloatTree& one = toOpenVdb(a.grid).tree();
    const openvdb::FloatTree& other = toOpenVdb(b.grid).tree();
    REQUIRE(one.hasSameTopology(other));
    auto leaf = other.cbeginLeaf();
    for (auto mine = one.cbeginLeaf(); mine; ++mine, ++leaf) REQUIRE(mine->buffer() == leaf->buffer());
}

} // namespace

TEST_CASE("the closest triangle is as near as the nearest, in bodies and sheets alike")
{
    VDBOUNCE_RANDOM(random);
    const TriangleMesh mesh = mixedMesh(random);
    const double voxel = 0.15;
    MeshToLevelSetOptions options = withVoxel(voxel);
    options.closest = true;
    const auto result = meshToLevelSet(mesh, options);
    const openvdb::FloatGrid& grid = toOpenVdb(result.grid);
    const auto& closest = dynamic_cast<const openvdb::Int32Grid&>(toOpenVdb(result.closest));
    CHECK(grid.activeVoxelCount() == closest.activeVoxelCount());
    std::size_t number = 0;
    for (auto voxelAt = closest.cbeginValueOn(); voxelAt; ++voxelAt) {
        REQUIRE(grid.tree().isValueOn(voxelAt.getCoord()));
        if (number++ % 7 != 0) continue;
        const openvdb::Vec3d w = grid.indexToWorld(voxelAt.getCoord());
        const Vec3d p(w[0], w[1], w[2]);
        REQUIRE(*voxelAt >= 0);
        REQUIRE(distanceTo(mesh, std::size_t(*voxelAt), p) <= bruteForceDistance(mesh, p) + 1e-6 * voxel);
    }
    CHECK(number > 1000);
}

TEST_CASE("asking for confidence or closest triangles changes no voxel")
{
    VDBOUNCE_RANDOM(random);
    TriangleMesh holes = sphereMesh(1.0, 3);
    for (std::size_t t = 0; t < holes.triangles.size(); t += 9) holes.triangles[t] = {0, 0, 0};
    for (const TriangleMesh& mesh : {mixedMesh(random), holes}) {
        for (const SignMethod method :
             {SignMethod::Auto, SignMethod::Winding, SignMethod::Parity, SignMethod::Flood, SignMethod::Unsigned}) {
            MeshToLevelSetOptions options = withVoxel(0.15);
            options.sign = method;
            const auto plain = meshToLevelSet(mesh, options);
            options.closest = options.confidence = true;
            INFO(signMethodName(method));
            requireSameLevelSets(plain, meshToLevelSet(mesh, options));
        }
    }
}

TEST_CASE("confidence is whole far from holes, low beside them, and a half where bodies overlap")
{
    MeshToLevelSetOptions options = withVoxel(0.1);
    options.confidence = true;
    TriangleMesh box = boxMesh(Vec3d(1, 1, 1));
    box.triangles.resize(10); // without its lid at z = 1
    const auto open = meshToLevelSet(box, options);
    double least = 1.0;
    double leastFar = 1.0;
    for (auto voxel = floats(open.confidence).cbeginValueOn(); voxel; ++voxel) {
        const openvdb::Vec3d w = floats(open.confidence).indexToWorld(voxel.getCoord());
        least = std::min(least, double(*voxel));
        if (w.z() < -0.8) leastFar = std::min(leastFar, double(*voxel));
    }
    CHECK(least < 0.1);
    CHECK(leastFar > 0.6);

    const TriangleMesh one = sphereMesh(1.0, 3);
    const TriangleMesh other = sphereMesh(0.7, 3, Vec3d(1, 0.2, 0.1));
    const auto overlap = meshToLevelSet(joined(one, other), options);
    const openvdb::FloatGrid& confidence = floats(overlap.confidence);
    std::size_t halves = 0;
    for (auto voxel = confidence.cbeginValueOn(); voxel; ++voxel) {
        const openvdb::Vec3d w = confidence.indexToWorld(voxel.getCoord());
        const Vec3d p(w[0], w[1], w[2]);
        if (bruteForceDistance(joined(one, other), p) < 1e-6) continue;
        const bool both = bruteForceInside(one, p) && bruteForceInside(other, p);
        halves += both ? 1 : 0;
        REQUIRE(*voxel == (both ? 0.5f : 1.0f));
    }
    CHECK(halves > 100);
    CHECK(overlap.doubtfulVoxels >= halves);
}
