// SPDX-License-Identifier: Apache-2.0
#include "support/meshes.h"
#include "support/random.h"

#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/io/openvdb_grid.h"

#include <Eigen/Geometry>

#include <algorithm>

using namespace vdbounce;
using namespace vdbounce::test;

// Unions of convex bodies, damaged at random and told by the shape that they had before.

namespace {

// An ellipsoid of triangles, turned somehow.
struct Body {
    Mat3d toBall;
    Vec3d centre;
    TriangleMesh mesh;

    Body(Random& random, int level)
    {
        const Mat3d turn = Eigen::AngleAxisd(random.uniform(0.1, 3.0), random.direction()).toRotationMatrix();
        const Vec3d half = random.in({Vec3d::Constant(0.5), Vec3d::Constant(1.2)});
        const Mat3d fromBall = turn * Mat3d(half.asDiagonal());
        toBall = fromBall.inverse();
        centre = random.in({Vec3d::Constant(-0.8), Vec3d::Constant(0.8)});
        mesh = sphereMesh(1.0, level);
        for (Vec3d& p : mesh.points) p = fromBall * p + centre;
    }
    bool holds(const Vec3d& p) const { return (toBall * (p - centre)).norm() < 1.0; }
    bool around(const Body& other) const
    {
        return std::all_of(other.mesh.points.begin(), other.mesh.points.end(),
                           [&](const Vec3d& p) { return holds(p); });
    }
};

struct Shape {
    TriangleMesh whole;
    std::vector<Body> bodies;

    Shape(Random& random, int count)
    {
        while (int(bodies.size()) < count) {
            Body body(random, 4);
            // One wholly within another would be taken for a cavity.
            if (std::any_of(bodies.begin(), bodies.end(),
                            [&](const Body& other) { return other.around(body) || body.around(other); }))
                continue;
            whole = joined(whole, body.mesh);
            bodies.push_back(std::move(body));
        }
    }
    // Of the facets, but for what lies between them and the round body.
    bool holds(const Vec3d& p) const
    {
        return std::any_of(bodies.begin(), bodies.end(), [&](const Body& body) { return body.holds(p); });
    }
};

template <class Chosen> void forShare(TriangleMesh& mesh, double share, Random& random, const Chosen& chosen)
{
    const std::size_t count = mesh.triangles.size();
    for (std::size_t t = 0; t < count; ++t) {
        if (random.uniform(0, 1) < share) chosen(t);
    }
}

void flipSome(TriangleMesh& mesh, Random& random)
{
    forShare(mesh, 0.3, random, [&](std::size_t t) { std::swap(mesh.triangles[t][1], mesh.triangles[t][2]); });
}

void deleteSome(TriangleMesh& mesh, double share, Random& random)
{
    std::vector<TriangleMesh::Triangle> kept;
    for (const auto& t : mesh.triangles) {
        if (random.uniform(0, 1) >= share) kept.push_back(t);
    }
    mesh.triangles = std::move(kept);
}

void duplicateSome(TriangleMesh& mesh, Random& random)
{
    forShare(mesh, 0.1, random, [&](std::size_t t) { mesh.triangles.push_back(mesh.triangles[t]); });
}

// Every triangle gets points of its own, each a little off.
void tear(TriangleMesh& mesh, double distance, Random& random)
{
    TriangleMesh torn;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto first = std::uint32_t(torn.points.size());
        for (std::size_t k = 0; k < 3; ++k) torn.points.push_back(mesh.corner(t, k) + distance * random.direction());
        torn.triangles.push_back({first, first + 1, first + 2});
    }
    mesh = std::move(torn);
}

// The share of voxels off the surface that are told right.
double shareRight(const TriangleMesh& mesh, const Shape& shape, double voxel)
{
    MeshToLevelSetOptions options;
    options.voxelSize = voxel;
    const auto result = meshToLevelSet(mesh, options);
    const openvdb::FloatGrid& grid = toOpenVdb(result.grid);
    std::size_t asked = 0;
    std::size_t right = 0;
    for (auto at = grid.cbeginValueOn(); at; ++at) {
        if (std::abs(*at) < voxel) continue;
        const openvdb::Vec3d w = grid.indexToWorld(at.getCoord());
        ++asked;
        right += shape.holds(Vec3d(w[0], w[1], w[2])) == (*at < 0.0f) ? 1 : 0;
    }
    REQUIRE(asked > 1000);
    return double(right) / double(asked);
}

} // namespace

TEST_CASE("bodies whose faces look at random have their sides")
{
    VDBOUNCE_RANDOM(random);
    for (int i = 0; i < 6; ++i) {
        const Shape shape(random, 1 + i % 4);
        TriangleMesh mesh = shape.whole;
        flipSome(mesh, random);
        duplicateSome(mesh, random);
        INFO("case " << i);
        CHECK(shareRight(mesh, shape, 0.08) >= 0.999);
    }
}

TEST_CASE("bodies without some of their faces have their sides")
{
    VDBOUNCE_RANDOM(random);
    for (int i = 0; i < 6; ++i) {
        const Shape shape(random, 1 + i % 4);
        TriangleMesh mesh = shape.whole;
        deleteSome(mesh, 0.01 * (1 + i % 5), random);
        INFO("case " << i);
        CHECK(shareRight(mesh, shape, 0.08) >= 0.99);
        flipSome(mesh, random);
        CHECK(shareRight(mesh, shape, 0.08) >= 0.99);
    }
}

TEST_CASE("bodies torn into single triangles have their sides")
{
    VDBOUNCE_RANDOM(random);
    for (int i = 0; i < 4; ++i) {
        const Shape shape(random, 1 + i % 3);
        TriangleMesh mesh = shape.whole;
        tear(mesh, 1e-4, random);
        INFO("case " << i);
        CHECK(shareRight(mesh, shape, 0.08) >= 0.999);
        flipSome(mesh, random);
        CHECK(shareRight(mesh, shape, 0.08) >= 0.999);
    }
}

TEST_CASE("a body, a torn body and a cloth in one mesh are told each by itself")
{
    VDBOUNCE_RANDOM(random);
    const Vec3d aside(4, 0, 0);
    TriangleMesh torn = boxMesh(Vec3d(0.5, 0.5, 0.5), aside);
    tear(torn, 1e-4, random);
    TriangleMesh cloth; // through the ball's middle
    cloth.points = {Vec3d(-2, -2, 0.02), Vec3d(2, -2, 0.02), Vec3d(2, 2, 0.02), Vec3d(-2, 2, 0.02)};
    cloth.triangles = {{0, 1, 2}, {0, 2, 3}};
    const TriangleMesh ball = sphereMesh(1.0, 3);
    MeshToLevelSetOptions options;
    options.voxelSize = 0.1;
    const auto result = meshToLevelSet(joined(joined(ball, torn), cloth), options);
    const openvdb::FloatGrid& grid = toOpenVdb(result.grid);
    std::size_t wrong = 0;
    for (auto at = grid.cbeginValueOn(); at; ++at) {
        const openvdb::Vec3d w = grid.indexToWorld(at.getCoord());
        const Vec3d p(w[0], w[1], w[2]);
        const double toBall = bruteForceDistance(ball, p) * (bruteForceInside(ball, p) ? -1 : 1);
        const double toBox = ((p - aside).cwiseAbs() - Vec3d::Constant(0.5)).maxCoeff();
        const double sheet = bruteForceDistance(cloth, p) - 0.1; // half of two voxels
        const double inside = std::min({toBall, toBox, sheet});
        if (std::abs(inside) > 1e-3 && (inside < 0.0) != (*at < 0.0f)) ++wrong;
    }
    CHECK(wrong == 0);
    CHECK(grid.tree().getValue(openvdb::Coord(0, 0, 5)) < 0.0f);
    CHECK(grid.tree().getValue(openvdb::Coord(40, 0, 0)) < 0.0f);
    CHECK(grid.tree().getValue(openvdb::Coord(15, 0, 0)) < 0.0f);
}

TEST_CASE("a cloth of edges far shorter than a voxel is a sheet, and a ball torn along such edges a ball")
{
    VDBOUNCE_RANDOM(random);
    TriangleMesh cloth;
    constexpr std::uint32_t kCells = 250;
    for (std::uint32_t i = 0; i <= kCells; ++i) {
        for (std::uint32_t j = 0; j <= kCells; ++j)
            cloth.points.emplace_back(1.0 / kCells * i, 1.0 / kCells * j, 0.3 * std::sin(3.0 / kCells * i));
    }
    for (std::uint32_t i = 0; i < kCells; ++i) {
        for (std::uint32_t j = 0; j < kCells; ++j) {
            const std::uint32_t a = (kCells + 1) * i + j;
            cloth.triangles.push_back({a, a + kCells + 1, a + kCells + 2});
            cloth.triangles.push_back({a, a + kCells + 2, a + 1});
        }
    }
    MeshToLevelSetOptions options;
    options.voxelSize = 0.1;
    CHECK(meshToLevelSet(cloth, options).sign == SignMethod::Unsigned);

    // One side of the ball's seam at x = 0 is moved off the other.
    TriangleMesh ball = sphereMesh(1.0, 6);
    TriangleMesh other = ball;
    for (Vec3d& p : other.points) p += 1e-5 * random.direction();
    const auto beyond = [&](const auto& t) {
        return (ball.points[t[0]] + ball.points[t[1]] + ball.points[t[2]]).x() < 0.0;
    };
    const auto split = std::stable_partition(ball.triangles.begin(), ball.triangles.end(), beyond);
    other.triangles.assign(split, ball.triangles.end());
    ball.triangles.erase(split, ball.triangles.end());
    options.voxelSize = 0.8; // edges are 0.03 voxels long
    const auto result = meshToLevelSet(joined(ball, other), options);
    for (auto at = toOpenVdb(result.grid).cbeginValueOn(); at; ++at) {
        const openvdb::Vec3d w = toOpenVdb(result.grid).indexToWorld(at.getCoord());
        REQUIRE(double(*at) == Approx(w.length() - 1.0).margin(1e-3));
    }
}

TEST_CASE("a soup far smaller than a voxel takes no time")
{
    VDBOUNCE_RANDOM(random);
    TriangleMesh soup;
    for (std::uint32_t i = 0; i < 20000; ++i) { // 9 s, were each rim's point compared with each other's
        const Vec3d at = random.in({Vec3d::Constant(-5), Vec3d::Constant(5)});
        for (int k = 0; k < 3; ++k) soup.points.push_back(at + 0.1 * random.direction());
        soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    MeshToLevelSetOptions options;
    options.voxelSize = 1000.0;
    CHECK(toOpenVdb(meshToLevelSet(soup, options).grid).activeVoxelCount() > 0);
}
