// SPDX-License-Identifier: Apache-2.0
#include "support/meshes.h"
#include "support/run_tool.h"

#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/build/mesh_tree.h"
#include "vdbounce/build/verify_level_set.h"
#include "vdbounce/io/mesh_file.h"
#include "vdbounce/io/openvdb_grid.h"

#include <filesystem>
#include <map>

using namespace vdbounce;
using namespace vdbounce::test;

// Meshes that './dev data' fetches; where they are missing these cases say so and check nothing.

namespace {

std::string fetchedPath(const std::string& name) { return sourcePath("data/fetched/" + name); }

bool allFetched(const std::vector<std::string>& names)
{
    for (const std::string& name : names) {
        if (std::filesystem::exists(fetchedPath(name))) continue;
        WARN(name << " is not there, so nothing is checked; ./dev data fetches it");
        return false;
    }
    return true;
}

MeshToLevelSetOptions dividedInto(int division, const TriangleMesh& mesh)
{
    MeshToLevelSetOptions options;
    options.voxelSize = boundingBox(mesh).size().maxCoeff() / division;
    return options;
}

// A mesh of the edges with one triangle, each as a triangle without area, to ask how far away they are.
TriangleMesh openEdges(const TriangleMesh& mesh)
{
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (const auto& t : mesh.triangles) {
        for (std::size_t c = 0; c < 3; ++c) ++uses[std::minmax(t[c], t[(c + 1) % 3])];
    }
    TriangleMesh edges;
    edges.points = mesh.points;
    for (const auto& [edge, count] : uses) {
        if (count == 1) edges.triangles.push_back({edge.first, edge.second, edge.second});
    }
    return edges;
}

} // namespace

TEST_CASE("faces in random directions change no sign and no distance of a closed mesh")
{
    if (!allFetched({"blobby.off", "blobby-shuffled.off"})) return;
    const TriangleMesh mesh = readMesh(fetchedPath("blobby.off"));
    const TriangleMesh shuffled = readMesh(fetchedPath("blobby-shuffled.off"));
    for (int division : {64, 150}) {
        INFO(division << " voxels on the longest side");
        const auto a = meshToLevelSet(mesh, dividedInto(division, mesh));
        const auto b = meshToLevelSet(shuffled, dividedInto(division, mesh));
        const openvdb::FloatGrid& right = toOpenVdb(a.grid);
        const openvdb::FloatGrid& left = toOpenVdb(b.grid);
        CHECK(left.activeVoxelCount() == right.activeVoxelCount());
        const auto accessor = left.getConstAccessor();
        const double voxel = right.voxelSize()[0];
        std::size_t wrong = 0;
        double largest = 0.0;
        for (auto v = right.cbeginValueOn(); v; ++v) {
            const double other = accessor.getValue(v.getCoord());
            if (std::abs(*v) > 1e-6 * voxel && (*v < 0.0f) != (other < 0.0)) ++wrong;
            largest = std::max(largest, std::abs(std::abs(double(*v)) - std::abs(other)));
        }
        CHECK(wrong == 0);
        // The same triangles whose corners come in another order.
        CHECK(largest <= 1e-5 * voxel);
    }
}

TEST_CASE("away from its holes an elephant has the signs of the whole one")
{
    if (!allFetched({"elephant.off", "elephant-with-holes.off"})) return;
    const TriangleMesh mesh = readMesh(fetchedPath("elephant.off"));
    const TriangleMesh holed = readMesh(fetchedPath("elephant-with-holes.off"));
    const TriangleMesh edges = openEdges(holed);
    const MeshTree nearHoles(edges);
    for (int division : {64, 150}) {
        const auto a = meshToLevelSet(mesh, dividedInto(division, mesh));
        const auto b = meshToLevelSet(holed, dividedInto(division, mesh));
        const openvdb::FloatGrid& whole = toOpenVdb(a.grid);
        const openvdb::FloatGrid& open = toOpenVdb(b.grid);
        const auto accessor = whole.getConstAccessor(); // beyond the band its values still have a sign
        const double voxel = open.voxelSize()[0];
        std::size_t away = 0;
        std::size_t same = 0;
        std::size_t sameOfAll = 0;
        for (auto v = open.cbeginValueOn(); v; ++v) {
            const bool isSame = (*v < 0.0f) == (accessor.getValue(v.getCoord()) < 0.0f);
            if (isSame) ++sameOfAll;
            const openvdb::Vec3d w = open.indexToWorld(v.getCoord());
            if (nearHoles.closest(Vec3d(w[0], w[1], w[2])).distance <= 3.0 * voxel) continue;
            ++away;
            if (isSame) ++same;
        }
        const double share = double(same) / double(away);
        INFO(division << " voxels on the longest side: " << 100.0 * share << " % of " << away
                      << " voxels away from the holes, " << 100.0 * double(sameOfAll) / double(open.activeVoxelCount())
                      << " % of all");
        CHECK(away > 1000);
        CHECK(share >= 0.99);
    }
}

TEST_CASE("deep inside an elephant with holes, and far outside of it, is where the whole one has it")
{
    if (!allFetched({"elephant.off", "elephant-with-holes.off"})) return;
    const TriangleMesh mesh = readMesh(fetchedPath("elephant.off"));
    const TriangleMesh holed = readMesh(fetchedPath("elephant-with-holes.off"));
    const TriangleMesh edges = openEdges(holed);
    const MeshTree nearHoles(edges);
    for (const auto& [division, step] :
         {std::pair(64, 1), std::pair(150, 3)}) { // coarse grids hold no whole leaf inside
        const MeshToLevelSetOptions options = dividedInto(division, mesh);
        const auto a = meshToLevelSet(mesh, options);
        const auto b = meshToLevelSet(holed, options);
        const auto whole = toOpenVdb(a.grid).getConstAccessor();
        const auto open = toOpenVdb(b.grid).getConstAccessor();
        std::size_t count[2] = {0, 0}; // outside, inside
        std::size_t same[2] = {0, 0};
        for (openvdb::Coord c : openvdb::CoordBBox(openvdb::Coord(-30), openvdb::Coord(30))) {
            c = openvdb::Coord(step * c.x(), step * c.y(), step * c.z());
            if (open.isValueOn(c)) continue; // the case above looks at these
            const Vec3d p = options.voxelSize * Vec3d(c.x(), c.y(), c.z());
            if (nearHoles.closest(p).distance <= 3.0 * options.voxelSize) continue;
            const bool inside = whole.getValue(c) < 0.0f;
            ++count[inside];
            if ((open.getValue(c) < 0.0f) == inside) ++same[inside];
        }
        INFO(division << " voxels on the longest side: " << same[0] << " of " << count[0] << " outside and " << same[1]
                      << " of " << count[1] << " inside are the same");
        CHECK(count[1] > 1000);
        CHECK(double(same[0]) >= 0.99 * double(count[0]));
        CHECK(double(same[1]) >= 0.99 * double(count[1]));
    }
}

TEST_CASE("every fetched mesh has exact distances")
{
    const std::string name = GENERATE("ChineseDragon-10kv.off", "armadillo.off", "blobby-shuffled.off", "blobby.off",
                                      "bunny00.off", "dragon_vrip.ply", "dragon_vrip_res2.ply", "dragon_vrip_res3.ply",
                                      "dragon_vrip_res4.ply", "elephant-with-holes.off", "elephant.off", "bunny.obj");
    if (name != "bunny.obj" && !allFetched({name})) return;
    const TriangleMesh mesh = readMesh(name == "bunny.obj" ? sourcePath("data/bunny.obj") : fetchedPath(name));
    const auto result = meshToLevelSet(mesh, dividedInto(100, mesh));
    const VerifyReport report = verifyLevelSet(result.grid, mesh, {3000});
    INFO(name);
    CHECK(report.samples >= 3000);
    CHECK(report.maxErrorVx < 1e-4);
}
