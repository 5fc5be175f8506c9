// SPDX-License-Identifier: Apache-2.0
#include "support/meshes.h"
#include "support/random.h"

#include "vdbounce/base/triangle_distance.h"
#include "vdbounce/build/band_leaves.h"
#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/field/vector_lookup.h"
#include "vdbounce/io/openvdb_grid.h"

#include <Eigen/Geometry>

#include <tbb/global_control.h>

using namespace vdbounce;
using namespace vdbounce::test;

// Grids of any transform against brute force in double precision, voxel by voxel.

namespace {

struct NamedTransform {
    std::string name;
    LinearTransform transform;
};

Mat3d scaled(double x, double y, double z) { return Vec3d(x, y, z).asDiagonal(); }

std::vector<NamedTransform> transforms(Random& random)
{
    const Mat3d turned = Eigen::AngleAxisd(random.uniform(0.1, 3.0), random.direction()).toRotationMatrix();
    Mat3d shear = Mat3d::Identity();
    shear(0, 1) = random.uniform(-0.7, 0.7);
    shear(2, 0) = random.uniform(-0.7, 0.7);
    const Vec3d origin = random.in({Vec3d::Constant(-9), Vec3d::Constant(9)});
    return {{"uniform", {scaled(0.11, 0.11, 0.11), origin}},
            {"sides of different length", {scaled(0.09, 0.16, 0.12), origin}},
            {"turned", {0.11 * turned, origin}},
            {"sheared", {0.1 * shear, origin}},
            {"mirrored", {scaled(-0.11, 0.11, 0.11), origin}},
            {"mirrored, turned, sheared, of different sides", {turned * shear * scaled(0.1, 0.13, -0.09), origin}}};
}

struct Bands {
    double exterior;
    double interior;
};

// The difference to what brute force says, in voxels; the first difference that matters in words.
struct Comparison {
    std::size_t active = 0;
    std::size_t wrong = 0;
    std::string first;

    void fail(const std::string& what, const openvdb::Coord& c, double value, double expected)
    {
        if (wrong++ > 0) return;
        std::ostringstream text;
        text << what << " at " << c << ": " << value << " for " << expected;
        first = text.str();
    }
};

// All voxels of a box around mesh and band. `side` is -1 inside, 1 outside, 0 where nobody knows.
Comparison compareAll(const MeshToLevelSetResult& result, const TriangleMesh& mesh, const LinearTransform& transform,
                      const Bands& band, const std::function<int(const Vec3d&)>& side)
{
    const openvdb::FloatGrid& grid = toOpenVdb(result.grid);
    const auto accessor = grid.getConstAccessor();
    const double voxel = transform.voxelSize().maxCoeff();
    const double unsure = 1e-5 * transform.smallestVoxelSize();
    openvdb::CoordBBox box;
    for (const Vec3d& p : mesh.points) {
        const Vec3d index = transform.toIndex(p);
        box.expand(openvdb::Coord::round(openvdb::Vec3d(index.x(), index.y(), index.z())));
    }
    const Vec3d reach = std::max(band.exterior, band.interior) * voxel * transform.worldToIndex().rowwise().norm();
    box.expand(int(reach.maxCoeff()) + 2);
    Comparison comparison;
    for (auto at = box.begin(); at; ++at) {
        const openvdb::Coord c = *at;
        const Vec3d p = transform.toWorld(Vec3d(c.x(), c.y(), c.z()));
        const double distance = bruteForceDistance(mesh, p);
        const double phi = double(accessor.getValue(c));
        const int expected = distance > unsure ? side(p) : 0;
        if (expected != 0 && (phi < 0.0) != (expected < 0)) comparison.fail("side", c, phi, expected * distance);
        const double width = (phi < 0.0 ? band.interior : band.exterior) * voxel;
        const bool on = accessor.isValueOn(c);
        comparison.active += on ? 1 : 0;
        if (std::abs(distance - width) > unsure && on != (distance < width))
            comparison.fail(on ? "active" : "not active", c, phi, distance);
        if (on && std::abs(std::abs(phi) - distance) > unsure) comparison.fail("distance", c, phi, distance);
    }
    return comparison;
}

int windingSide(const TriangleMesh& mesh, const Vec3d& p)
{
    double winding = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        winding += windingContribution(p, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2));
    return std::abs(winding) > 0.5 ? -1 : 1;
}

MeshToLevelSetOptions optionsFor(const LinearTransform& transform, const Bands& band)
{
    MeshToLevelSetOptions options;
    options.transform = transform;
    options.exteriorVx = band.exterior;
    options.interiorVx = band.interior;
    return options;
}

// The box, moved and turned somehow.
TriangleMesh someBox(Random& random)
{
    TriangleMesh box = boxMesh(Vec3d(0.6, 0.35, 0.45));
    const Mat3d turn = Eigen::AngleAxisd(random.uniform(0.1, 3.0), random.direction()).toRotationMatrix();
    const Vec3d move = random.in({Vec3d::Constant(-1), Vec3d::Constant(1)});
    for (Vec3d& p : box.points) p = turn * p + move;
    return box;
}

// Triangles of every shape: from a ten thousandth of a voxel to a few voxels, needles, slivers, points twice.
TriangleMesh soup(Random& random, double voxel, int count)
{
    TriangleMesh mesh;
    for (int i = 0; i < count; ++i) {
        const Vec3d at = voxel * random.in({Vec3d::Constant(-6), Vec3d::Constant(6)});
        const double size = voxel * std::pow(10.0, random.uniform(-4.0, 1.0));
        const Vec3d along = size * random.direction();
        const Vec3d across = size * random.direction();
        const double thin = std::pow(10.0, random.uniform(-9.0, -1.0));
        const auto first = std::uint32_t(mesh.points.size());
        switch (i % 5) {
        case 0: mesh.points.insert(mesh.points.end(), {at, at + along, at + across}); break;
        case 1: mesh.points.insert(mesh.points.end(), {at, at + along, at + along + thin * across}); break;
        case 2: mesh.points.insert(mesh.points.end(), {at, at + along, at + 0.4 * along + thin * across}); break;
        case 3: mesh.points.insert(mesh.points.end(), {at, at + along, at + 0.3 * along}); break;
        default: mesh.points.insert(mesh.points.end(), {at, at, at}); break;
        }
        mesh.triangles.push_back({first, first + 1, i % 10 == 4 ? first : first + 2});
    }
    return mesh;
}

bool sameBits(const MeshToLevelSetResult& a, const MeshToLevelSetResult& b)
{
    const openvdb::FloatTree& one = toOpenVdb(a.grid).tree();
    const openvdb::FloatTree& other = toOpenVdb(b.grid).tree();
    if (!one.hasSameTopology(other) || one.leafCount() == 0) return false;
    auto leaf = other.cbeginLeaf();
    for (auto mine = one.cbeginLeaf(); mine; ++mine, ++leaf) {
        const float* values = mine->buffer().data();
        if (!std::equal(values, values + BandLeaf::kVoxels, leaf->buffer().data())) return false;
    }
    return true;
}

} // namespace

TEST_CASE("under any transform every voxel has the distance and the side that brute force says")
{
    VDBOUNCE_RANDOM(random);
    for (const auto& [name, transform] : transforms(random)) {
        for (const Bands& band : {Bands{3, 3}, Bands{1, 2.5}, Bands{4.5, 1}}) {
            INFO(name << ", bands " << band.exterior << " and " << band.interior);
            const TriangleMesh mesh = someBox(random);
            const auto result = meshToLevelSet(mesh, optionsFor(transform, band));
            CHECK(result.warnings.empty());
            const Comparison comparison =
                compareAll(result, mesh, transform, band, [&](const Vec3d& p) { return windingSide(mesh, p); });
            INFO(comparison.first);
            CHECK(comparison.active > 100);
            CHECK(comparison.wrong == 0);
        }
    }
}

TEST_CASE("bands of one voxel and of twelve are exact")
{
    VDBOUNCE_RANDOM(random);
    const LinearTransform transform(scaled(0.15, 0.15, 0.15), Vec3d(0.3, 0.1, -0.2));
    const TriangleMesh mesh = someBox(random);
    for (const Bands& band : {Bands{1, 1}, Bands{12, 1}, Bands{1, 12}, Bands{12, 12}}) {
        INFO("bands " << band.exterior << " and " << band.interior);
        const auto result = meshToLevelSet(mesh, optionsFor(transform, band));
        const Comparison comparison =
            compareAll(result, mesh, transform, band, [&](const Vec3d& p) { return windingSide(mesh, p); });
        INFO(comparison.first);
        CHECK(comparison.wrong == 0);
    }
}

TEST_CASE("triangles of any shape have exact distances under any transform")
{
    VDBOUNCE_RANDOM(random);
    for (const auto& [name, transform] : transforms(random)) {
        INFO(name);
        const double voxel = transform.voxelSize().maxCoeff();
        const TriangleMesh mesh = soup(random, voxel, 60);
        MeshToLevelSetOptions options = optionsFor(transform, {2.5, 2.5});
        options.sign = SignMethod::Unsigned;
        options.thicknessVx = 1e-6; // as good as none
        const auto result = meshToLevelSet(mesh, options);
        // A voxel on the mesh itself is inside of the sheet.
        const Comparison comparison = compareAll(result, mesh, transform, {2.5, 2.5}, [](const Vec3d&) { return 1; });
        INFO(comparison.first);
        CHECK(comparison.active > 100);
        CHECK(comparison.wrong == 0);
    }
}

TEST_CASE("meshes far from the origin and from each other are exact")
{
    VDBOUNCE_RANDOM(random);
    const Vec3d far(1e7, -1e7, 0.9e7);
    TriangleMesh mesh = someBox(random);
    for (Vec3d& p : mesh.points) p += far;
    const LinearTransform transform(scaled(0.11, 0.11, 0.11), Vec3d::Zero());
    const auto result = meshToLevelSet(mesh, optionsFor(transform, {3, 3}));
    const Comparison comparison =
        compareAll(result, mesh, transform, {3, 3}, [&](const Vec3d& p) { return windingSide(mesh, p); });
    INFO(comparison.first);
    CHECK(comparison.active > 100);
    CHECK(comparison.wrong == 0);

    const auto apart = meshToLevelSet(joined(someBox(random), mesh), optionsFor(transform, {3, 3}));
    CHECK(toOpenVdb(apart.grid).tree().getValue(openvdb::Coord(9, 9, 9) + openvdb::Coord(200000)) > 0);
    std::size_t wrong = 0;
    for (auto voxel = toOpenVdb(result.grid).cbeginValueOn(); voxel; ++voxel)
        wrong += toOpenVdb(apart.grid).tree().getValue(voxel.getCoord()) == *voxel ? 0 : 1;
    CHECK(wrong == 0);
}

TEST_CASE("a conversion has the same bits on any processor and with any number of threads")
{
    VDBOUNCE_RANDOM(random);
    const LinearTransform transform = transforms(random).back().transform;
    const TriangleMesh mesh = joined(joined(sphereMesh(0.8, 3), someBox(random)), soup(random, 0.1, 40));
    const MeshToLevelSetOptions options = optionsFor(transform, {3, 4});
    const auto best = meshToLevelSet(mesh, options);
    for (const std::string& target : vectorTargets()) {
        INFO(target);
        chooseVectorTarget(target);
        const auto other = meshToLevelSet(mesh, options);
        chooseVectorTarget("");
        CHECK(sameBits(other, best));
    }
    for (const std::size_t threads : {1u, 2u, 5u}) {
        INFO(threads << " threads");
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        CHECK(sameBits(meshToLevelSet(mesh, options), best));
    }
}
