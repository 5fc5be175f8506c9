// SPDX-License-Identifier: Apache-2.0
#include "support/meshes.h"
#include "support/random.h"

#include "vdbounce/base/triangle_distance.h"
#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/build/nearest_in_leaf.h"
#include "vdbounce/io/openvdb_grid.h"

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

constexpr int kKinds = 5;

// Triangles near the leaf of the voxels 0 to 7 that reach up to `size` voxels away, in several shapes.
TriangleMesh longTriangles(Random& random, int kind, double size)
{
    TriangleMesh mesh;
    for (int i = 0; i < 6; ++i) {
        const Vec3d at = random.in({Vec3d::Zero(), Vec3d::Constant(7.0)});
        const Vec3d e = size * random.direction();
        const Vec3d f = random.direction();
        const double thin = std::pow(10.0, random.uniform(-8.0, 0.0));
        const auto first = std::uint32_t(mesh.points.size());
        switch (kind) {
        case 0: mesh.points.insert(mesh.points.end(), {at, at + e, at + size * f}); break;
        case 1: mesh.points.insert(mesh.points.end(), {at, at - e, at - e + thin * f}); break;
        case 2: mesh.points.insert(mesh.points.end(), {at - e, at + e, at + 0.3 * e + thin * f}); break;
        case 3: mesh.points.insert(mesh.points.end(), {at - e, at + 0.9 * e, at + thin * f}); break;
        default: mesh.points.insert(mesh.points.end(), {at - e, at + e, at + size * f}); break;
        }
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

// By how much farther a voxel's triangle is than the nearest one, at most; a voxel without one counts as a whole.
double worstChoice(const TriangleMesh& mesh, double band)
{
    LeafPlace place;
    place.origin = Vec3d::Zero();
    place.indexToWorld = place.worldToIndex = Mat3d::Identity();
    place.reach = band;
    NearestInLeaf nearest;
    nearest.clear(place.reach);
    const std::vector<std::uint32_t> list = {0, 1, 2, 3, 4, 5};
    findNearestInLeaf(mesh, list.data(), list.size(), place, nearest);
    double worst = 0.0;
    for (int v = 0; v < NearestInLeaf::kVoxels; ++v) {
        const Vec3d p(v >> 6, v >> 3 & 7, v & 7);
        const double least = bruteForceDistance(mesh, p);
        const std::uint32_t t = nearest.triangle[v];
        if (t == NearestInLeaf::kNone) {
            if (least < band - 1e-5) return 1.0;
            continue;
        }
        const Vec3d q = closestPointOnTriangle(p, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2));
        worst = std::max(worst, (q - p).norm() - least);
    }
    return worst;
}

} // namespace

TEST_CASE("the nearest of triangles of ten thousand voxels is found in every shape")
{
    VDBOUNCE_RANDOM(random);
    const int kind = GENERATE(range(0, kKinds));
    for (const double size : {100.0, 1e4}) {
        INFO("shape " << kind << " of " << size << " voxels");
        double worst = 0.0;
        for (int i = 0; i < 100; ++i) worst = std::max(worst, worstChoice(longTriangles(random, kind, size), 3.0));
        CHECK(worst <= 1e-5);
    }
}

TEST_CASE("a needle of ten thousand voxels aslant costs the voxels beside it only")
{
    TriangleMesh needle;
    needle.points = {Vec3d(0.3, 0.2, 0.1), Vec3d(9000.3, 8000.2, -7000.1), Vec3d(9000.3, 8000.7, -7000.1)};
    needle.triangles = {{0, 1, 2}};
    MeshToLevelSetOptions options;
    options.voxelSize = 1.0;
    options.sign = SignMethod::Unsigned;
    const auto result = meshToLevelSet(needle, options); // hours, were all leaves of its box looked at
    const openvdb::FloatGrid& grid = toOpenVdb(result.grid);
    std::size_t number = 0;
    double worst = 0.0;
    for (auto voxel = grid.cbeginValueOn(); voxel; ++voxel) {
        if (number++ % 101 != 0) continue;
        const openvdb::Vec3d w = grid.indexToWorld(voxel.getCoord());
        const double distance = bruteForceDistance(needle, Vec3d(w[0], w[1], w[2]));
        worst = std::max(worst, std::abs(double(*voxel) - (distance - 1.0)));
    }
    // A needle as long as that, within four voxels.
    const double expected = M_PI * 16.0 * (needle.points[1] - needle.points[0]).norm();
    CHECK(double(number) == Approx(expected).epsilon(0.05));
    CHECK(worst < 1e-6);
}
