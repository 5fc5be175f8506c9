// SPDX-License-Identifier: Apache-2.0
#include "support/random.h"

#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/implicit/heightfield.h"
#include "vdbounce/implicit/heightfield_mesh.h"
#include "vdbounce/io/openvdb_grid.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <openvdb/openvdb.h>

#include <cmath>

using namespace vdbounce;

namespace {

HeightMap randomMap(test::Random& random, int columns, int rows)
{
    HeightMap map{columns, rows, std::vector<double>(std::size_t(columns * rows))};
    for (double& value : map.values) value = random.uniform(0, 1);
    return map;
}

} // namespace

TEST_CASE("a heightfield's mesh is closed and faces outwards")
{
    VDBOUNCE_RANDOM(random);
    const int sizes[][2] = {{2, 2}, {2, 7}, {9, 2}, {13, 8}};
    for (const auto& size : sizes) {
        const HeightMap map = randomMap(random, size[0], size[1]);
        const TriangleMesh mesh = heightfieldMesh(map, {Vec3d(-3, 1, 2), Vec3d(1, 5, 9), {}});
        CHECK(inspectEdges(mesh).closedAndOriented());
        double volume = 0.0;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
            volume += mesh.corner(t, 0).dot(mesh.corner(t, 1).cross(mesh.corner(t, 2))) / 6.0;
        // A triangle's mean height is that of its corners.
        double sum = 0.0;
        double lowest = 1.0;
        for (int j = 0; j + 1 < map.rows; ++j) {
            for (int i = 0; i + 1 < map.columns; ++i)
                sum += (2.0 * (map.at(i, j) + map.at(i + 1, j + 1)) + map.at(i + 1, j) + map.at(i, j + 1)) / 6.0;
        }
        for (double value : map.values) lowest = std::min(lowest, value);
        const double cells = (map.columns - 1) * (map.rows - 1);
        CHECK(volume == Approx(4.0 * 7.0 * (4.0 * (sum / cells - lowest) + 0.7)));
        const Box box = boundingBox(mesh);
        CHECK((box.min - Vec3d(-3, 1 + 4 * lowest - 0.7, 2)).norm() < 1e-12);
        CHECK(box.max.x() == Approx(1.0));
        CHECK(box.max.z() == Approx(9.0));
    }
}

TEST_CASE("the level set of a heightfield's mesh is the heightfield's distance")
{
    VDBOUNCE_RANDOM(random);
    const HeightMap map = randomMap(random, 17, 12);
    const HeightfieldOptions options{Vec3d(-1, 0, 2), Vec3d(1, 0.5, 3), -0.25};
    const HeightfieldField field(map, options);
    MeshToLevelSetOptions conversion;
    conversion.voxelSize = 0.02;
    const MeshToLevelSetResult made = meshToLevelSet(heightfieldMesh(map, options), conversion);
    const openvdb::FloatGrid& grid = toOpenVdb(made.grid);
    double worst = 0.0;
    std::size_t count = 0;
    for (auto voxel = grid.cbeginValueOn(); voxel; ++voxel, ++count) {
        const openvdb::Vec3d at = grid.indexToWorld(voxel.getCoord());
        worst = std::max(worst, std::abs(field.phi(Vec3d(at.x(), at.y(), at.z()), 0.0) - double(*voxel)));
    }
    CHECK(count > 20000);
    CHECK(worst < 1e-6 * 3 * conversion.voxelSize + 1e-12);
}
