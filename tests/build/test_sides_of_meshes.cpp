// SPDX-License-Identifier: Apache-2.0
#include "support/meshes.h"
#include "support/random.h"

#include "vdbounce/base/triangle_distance.h"
#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/field/distance_field.h"
#include "vdbounce/io/openvdb_grid.h"

#include <Eigen/Geometry>

#include <algorithm>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

double windingOf(const TriangleMesh& mesh, const Vec3d& p)
{
    double winding = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        winding += windingContribution(p, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2));
    return winding;
}

using SideOf = std::function<int(const Vec3d&)>; // -1 inside, 1 outside, 0 where nobody knows

// Active voxels off the surface whose side is another than that, if they are more than a share of all.
std::string wrongSides(const MeshToLevelSetResult& result, const SideOf& sideOf, double share = 0.0)
{
    const openvdb::FloatGrid& grid = toOpenVdb(result.grid);
    std::ostringstream text;
    std::size_t wrong = 0;
    for (auto voxel = grid.cbeginValueOn(); voxel; ++voxel) {
        if (std::abs(*voxel) < 1e-5f * grid.background()) continue;
        const openvdb::Vec3d w = grid.indexToWorld(voxel.getCoord());
        const Vec3d p(w[0], w[1], w[2]);
        const int side = sideOf(p);
        if (side != 0 && (*voxel < 0.0f) != (side < 0) && wrong++ == 0)
            text << "phi " << *voxel << " at (" << p.transpose() << ")";
    }
    if (double(wrong) <= share * double(grid.activeVoxelCount()))
        return grid.activeVoxelCount() > 100 ? "" : "next to nothing is active";
    return std::to_string(wrong) + " wrong: " + text.str();
}

// By the solid angles of all triangles; nobody knows nearer to a half than that.
SideOf byWinding(const TriangleMesh& mesh, double unsure)
{
    return [&mesh, unsure](const Vec3d& p) {
        const double winding = std::abs(windingOf(mesh, p));
        return std::abs(winding - 0.5) < unsure ? 0 : (winding > 0.5 ? -1 : 1);
    };
}

MeshToLevelSetResult converted(const TriangleMesh& mesh, const LinearTransform& transform, SignMethod method)
{
    MeshToLevelSetOptions options;
    options.transform = transform;
    options.sign = method;
    return meshToLevelSet(mesh, options);
}

LinearTransform uniform(double voxel) { return LinearTransform(voxel * Mat3d::Identity(), Vec3d(0.013, 0.017, 0.019)); }
LinearTransform mirrored(double voxel)
{
    return LinearTransform(voxel * Mat3d(Vec3d(1, -1, 1).asDiagonal()), Vec3d(0.013, 0.017, 0.019));
}

TriangleMesh shuffled(TriangleMesh mesh, Random& random)
{
    for (auto& t : mesh.triangles) {
        if (random.uniform(0, 1) < 0.3) std::swap(t[1], t[2]);
    }
    return mesh;
}

TriangleMesh withHoles(TriangleMesh mesh, double share, Random& random)
{
    mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(),
                                        [&](const auto&) { return random.uniform(0, 1) < share; }),
                         mesh.triangles.end());
    return mesh;
}

// The sides of a box of those whole sizes with a corner at the origin, open above and below.
TriangleMesh squareTube(double side, double height)
{
    TriangleMesh tube = boxMesh(0.5 * Vec3d(side, side, height), 0.5 * Vec3d(side, side, height));
    tube.triangles.erase(std::remove_if(tube.triangles.begin(), tube.triangles.end(),
                                        [&](const auto& t) {
                                            const double z = tube.points[t[0]].z();
                                            return tube.points[t[1]].z() == z && tube.points[t[2]].z() == z;
                                        }),
                         tube.triangles.end());
    return tube;
}

} // namespace

TEST_CASE("winding as asked for is what all solid angles say at every voxel")
{
    VDBOUNCE_RANDOM(random);
    // Caps over holes count as walls where the winding number at nearly all of them is within a quarter of a half.
    const std::vector<std::tuple<std::string, TriangleMesh, double>> meshes = {
        {"overlapping", joined(sphereMesh(1.0, 2), sphereMesh(0.7, 2, Vec3d(0.8, 0.3, 0.2))), 1e-6},
        {"nested", joined(joined(sphereMesh(1.2, 2), sphereMesh(0.8, 2)), flipped(sphereMesh(0.4, 2))), 1e-6},
        {"one taken away", joined(sphereMesh(1.0, 2), flipped(sphereMesh(0.7, 2, Vec3d(0.8, 0.3, 0.2)))), 1e-6},
        {"shuffled", shuffled(sphereMesh(1.0, 3), random), 0.06},
        {"shuffled and overlapping", shuffled(joined(sphereMesh(1.0, 2), boxMesh(Vec3d(1.4, 0.4, 0.3))), random), 0.06},
        {"with holes", withHoles(sphereMesh(1.0, 3), 0.2, random), 0.3},
        {"hardly any left", withHoles(sphereMesh(1.0, 3), 0.8, random), 0.3},
        {"a tube", squareTube(1.5, 1.0), 0.3}};
    for (const auto& [name, mesh, unsure] : meshes) {
        for (const LinearTransform& transform : {uniform(0.11), mirrored(0.12)}) {
            INFO(name << (transform.indexToWorld()(1, 1) < 0 ? ", mirrored" : ""));
            CHECK(wrongSides(converted(mesh, transform, SignMethod::Winding), byWinding(mesh, unsure),
                             unsure > 0.25 ? 0.002 : 0.0) == "");
        }
    }
}

TEST_CASE("parity as asked for tells by crossings whichever way faces look")
{
    VDBOUNCE_RANDOM(random);
    const TriangleMesh balls = joined(sphereMesh(1.0, 3), sphereMesh(0.7, 3, Vec3d(0.8, 0.3, 0.2)));
    const TriangleMesh one = sphereMesh(1.0, 3);
    const TriangleMesh other = sphereMesh(0.7, 3, Vec3d(0.8, 0.3, 0.2));
    const SideOf odd = [&](const Vec3d& p) { return bruteForceInside(one, p) != bruteForceInside(other, p) ? -1 : 1; };
    CHECK(wrongSides(converted(shuffled(balls, random), uniform(0.11), SignMethod::Parity), odd) == "");
    CHECK(wrongSides(converted(shuffled(balls, random), mirrored(0.12), SignMethod::Parity), odd) == "");
}

TEST_CASE("flood fills what cannot be reached")
{
    const TriangleMesh shell = joined(sphereMesh(1.2, 3), flipped(sphereMesh(0.6, 3)));
    const TriangleMesh outer = sphereMesh(1.2, 3);
    const SideOf filled = [&](const Vec3d& p) {
        // Single voxels closer to a cavity's wall than to the next voxel are told by parity.
        if (std::abs(p.norm() - 0.6) < 0.12) return 0;
        return bruteForceInside(outer, p) ? -1 : 1;
    };
    CHECK(wrongSides(converted(shell, uniform(0.11), SignMethod::Flood), filled) == "");
    CHECK(wrongSides(converted(shell, mirrored(0.12), SignMethod::Flood), filled) == "");
}

TEST_CASE("columns through vertices and edges, and faces on voxel planes, tell every side")
{
    // Boxes of whole numbers on voxels of one and of a half, alone and overlapping, turned by right angles and by 45
    // degrees, so that columns run through vertices, along edges and within faces.
    const Mat3d diagonal = Eigen::AngleAxisd(M_PI / 4, Vec3d::UnitZ()).toRotationMatrix() * std::sqrt(2.0);
    for (const Mat3d& turn : {Mat3d(Mat3d::Identity()), Mat3d(diagonal.array().round())}) {
        for (const double voxel : {1.0, 0.5}) {
            TriangleMesh mesh = joined(boxMesh(Vec3d(4, 4, 4)), boxMesh(Vec3d(2, 2, 5), Vec3d(4, 2, 1)));
            for (Vec3d& p : mesh.points) p = turn * p;
            const LinearTransform transform(voxel * Mat3d::Identity(), Vec3d::Zero());
            INFO("voxel " << voxel << ", first column " << turn.col(0).transpose());
            CHECK(wrongSides(converted(mesh, transform, SignMethod::Auto), byWinding(mesh, 1e-6)) == "");
            CHECK(wrongSides(converted(mesh, transform, SignMethod::Winding), byWinding(mesh, 1e-6)) == "");
        }
    }
    // An octahedron whose corners and edges lie on columns.
    TriangleMesh octahedron = sphereMesh(6.0, 0);
    const LinearTransform ones(Mat3d::Identity(), Vec3d::Zero());
    CHECK(wrongSides(converted(octahedron, ones, SignMethod::Auto), byWinding(octahedron, 1e-6)) == "");
}

TEST_CASE("voxel centres in the plane of an opening are told as those beside it")
{
    const LinearTransform ones(Mat3d::Identity(), Vec3d::Zero());
    for (const double height : {1.0, 2.0, 4.0}) {
        const TriangleMesh tube = squareTube(10.0, height);
        INFO("height " << height);
        CHECK(wrongSides(converted(tube, ones, SignMethod::Winding), byWinding(tube, 0.25)) == "");
    }
}

TEST_CASE("a point of no triangle changes nothing wherever it is")
{
    TriangleMesh mesh = boxMesh(Vec3d(1, 1, 1));
    for (const double far : {1e6, 1e15, 1e300}) {
        mesh.points.emplace_back(far, -far, 0.0);
        const auto result = converted(mesh, uniform(0.1), SignMethod::Auto);
        INFO(far);
        CHECK(wrongSides(result, byWinding(mesh, 1e-6)) == "");
    }
}

TEST_CASE("a peg in a block is solid whichever side it is flush with")
{
    for (int axis = 0; axis < 3; ++axis) {
        for (const double proud : {0.0, 0.2}) {
            Vec3d extent = Vec3d::Constant(2.0);
            Vec3d centre = Vec3d::Constant(0.03);
            extent[axis] = 2.5;
            centre[axis] = 2.5 + proud;
            const TriangleMesh mesh = joined(boxMesh(Vec3d::Constant(5.0)), boxMesh(extent, centre));
            INFO("axis " << axis << ", proud by " << proud);
            CHECK(DistanceField(converted(mesh, uniform(0.5), SignMethod::Auto).grid).phi(centre) < 0.0);
        }
    }
}
