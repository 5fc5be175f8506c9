// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/mesh_to_level_set.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/parallel.h"
#include "vdbounce/build/band_leaves.h"
#include "vdbounce/build/inside.h"
#include "vdbounce/build/mesh_tree.h"
#include "vdbounce/io/number_text.h"
#include "vdbounce/io/openvdb_grid.h"
#include "vdbounce/io/vdb_archive.h"

#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace vdbounce {
namespace {

// OpenVDB refuses a scale whose determinant is below 3e-15.
constexpr double kSmallestVoxel = 1.5e-5;
constexpr std::size_t kLeavesPerTask = 4;

void validate(const MeshToLevelSetOptions& options)
{
    const auto require = [](bool good, const char* name, double value, const char* remedy) {
        if (!good) throw UsageError(name, numberText(value) + " is out of range", remedy);
    };
    require(options.voxelSize > 0.0 && std::isfinite(options.voxelSize), "voxel size", options.voxelSize,
            "give a positive length");
    require(options.voxelSize >= kSmallestVoxel, "voxel size", options.voxelSize,
            "OpenVDB's transforms hold no smaller voxels than 1.5e-5; scale the mesh up");
    require(options.exteriorVx >= 1.0 && options.exteriorVx < 1e6, "exterior band", options.exteriorVx,
            "give at least 1 voxel");
    require(options.interiorVx >= 1.0 && options.interiorVx < 1e6, "interior band", options.interiorVx,
            "give at least 1 voxel");
    require(options.thicknessVx > 0.0 && options.thicknessVx < 1e6, "thickness", options.thicknessVx,
            "give a positive number of voxels");
}

struct Band {
    float exterior; // world units
    float interior;
};

// Writes signed distances into a grid: active within the band, the band's width with the sign beyond it.
openvdb::FloatGrid::Ptr assemble(const std::vector<BandLeaf>& leaves, const Band& band,
                                 const MeshToLevelSetOptions& options,
                                 const std::function<float(std::size_t, int)>& signedDistance)
{
    auto grid = openvdb::FloatGrid::create(band.exterior);
    grid->setName(options.gridName);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(options.voxelSize));
    std::vector<openvdb::FloatTree::LeafNodeType*> targets;
    for (const BandLeaf& leaf : leaves) {
        const Vec3i origin = leaf.voxel(0);
        targets.push_back(grid->tree().touchLeaf(openvdb::Coord(origin.x(), origin.y(), origin.z())));
    }
    forEachIndex(leaves.size(), kLeavesPerTask, [&](std::size_t i) {
        for (int v = 0; v < BandLeaf::kVoxels; ++v) {
            const float phi = signedDistance(i, v);
            const auto offset = openvdb::Index(v);
            if (phi < band.exterior && phi > -band.interior) {
                targets[i]->setValueOn(offset, phi);
            } else {
                targets[i]->setValueOff(offset, phi > 0.0f ? band.exterior : -band.interior);
            }
        }
    });
    return grid;
}

InsideTest insideTest(SignMethod sign)
{
    if (sign == SignMethod::Parity) return InsideTest::Parity;
    return sign == SignMethod::Flood ? InsideTest::Flood : InsideTest::Winding;
}

// Winding needs faces that agree on which way is out, parity needs a surface without holes.
SignMethod chosenMethod(const EdgeReport& edges, SignMethod asked)
{
    if (asked != SignMethod::Auto) return asked;
    return edges.inconsistent > 0 && edges.open == 0 ? SignMethod::Parity : SignMethod::Winding;
}

std::vector<std::string> warnAboutEdges(const EdgeReport& edges, SignMethod sign)
{
    std::vector<std::string> warnings;
    if (edges.open > 0) {
        warnings.push_back("the mesh is open (" + std::to_string(edges.open) +
                           " edges with one triangle): the sign across its holes is the " + signMethodName(sign) +
                           " method's guess, and phi jumps there; close the mesh, or use --sign unsigned for a sheet");
    }
    if (edges.inconsistent > 0) {
        const std::string found = std::to_string(edges.inconsistent) + " edges join triangles that face opposite ways";
        warnings.push_back(found + (sign == SignMethod::Parity ? ": inside is told by parity, which does not ask them"
                                                               : "; orient the mesh or try --sign parity"));
    }
    if (edges.nonManifold > 0)
        warnings.push_back(std::to_string(edges.nonManifold) + " edges have three triangles or more");
    return warnings;
}

openvdb::FloatGrid::Ptr makeSheet(const TriangleMesh& mesh, const MeshToLevelSetOptions& options, Progress& progress)
{
    const double half = 0.5 * options.thicknessVx * options.voxelSize;
    const Band band{float(options.exteriorVx * options.voxelSize), float(half)};
    const auto leaves =
        measureBandLeaves(mesh, options.voxelSize, options.exteriorVx * options.voxelSize + half, progress);
    return assemble(leaves, band, options, [&](std::size_t leaf, int v) {
        // A voxel centre on the mesh itself is inside by the whole half thickness, and must count as inside the band.
        return std::max(leaves[leaf].distance[std::size_t(v)] - float(half), std::nextafter(-float(half), 0.0f));
    });
}

openvdb::FloatGrid::Ptr makeSolid(const TriangleMesh& mesh, const EdgeReport& edges, SignMethod sign,
                                  const MeshToLevelSetOptions& options, Progress& progress)
{
    const Band band{float(options.exteriorVx * options.voxelSize), float(options.interiorVx * options.voxelSize)};
    const double reach = std::max(options.exteriorVx, options.interiorVx) * options.voxelSize;
    const auto leaves = measureBandLeaves(mesh, options.voxelSize, reach, progress);
    const MeshTree tree(mesh);
    throwIfStopped(progress);
    const InsideFlags inside = findInside(leaves, tree, insideTest(sign), edges.open == 0, options.voxelSize, progress);
    auto grid = assemble(leaves, band, options, [&](std::size_t leaf, int v) {
        const float distance = leaves[leaf].distance[std::size_t(v)];
        return inside.voxels[leaf][std::size_t(v)] ? -distance : distance;
    });
    for (const Vec3i& leaf : inside.emptyLeaves) {
        const Vec3i origin = leaf * BandLeaf::kSide;
        grid->tree().addTile(1, openvdb::Coord(origin.x(), origin.y(), origin.z()), -band.interior, /*active=*/false);
    }
    return grid;
}

} // namespace

const char* signMethodName(SignMethod method)
{
    switch (method) {
    case SignMethod::Auto: return "auto";
    case SignMethod::Winding: return "winding";
    case SignMethod::Parity: return "parity";
    case SignMethod::Flood: return "flood";
    case SignMethod::Unsigned: return "unsigned";
    }
    return "";
}

MeshToLevelSetResult meshToLevelSet(const TriangleMesh& mesh, const MeshToLevelSetOptions& options, Progress& progress)
{
    validate(options);
    initializeOpenVdb();
    MeshToLevelSetResult result;
    const EdgeReport edges = inspectEdges(mesh);
    result.sign = chosenMethod(edges, options.sign);
    openvdb::FloatGrid::Ptr grid;
    if (result.sign == SignMethod::Unsigned) {
        grid = makeSheet(mesh, options, progress);
    } else {
        grid = makeSolid(mesh, edges, result.sign, options, progress);
        result.warnings = warnAboutEdges(edges, result.sign);
    }
    throwIfStopped(progress);
    // Leaves that hold nothing but one side become tiles.
    openvdb::tools::pruneLevelSet(grid->tree());
    result.grid = toLevelSetGrid(grid, options.gridName);
    return result;
}

} // namespace vdbounce
