// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/mesh_to_level_set.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/parallel.h"
#include "vdbounce/build/band_leaves.h"
#include "vdbounce/build/mesh_tree.h"
#include "vdbounce/build/space_regions.h"
#include "vdbounce/io/number_text.h"
#include "vdbounce/io/openvdb_grid.h"
#include "vdbounce/io/vdb_archive.h"

#include <openvdb/tools/Prune.h>
#include <openvdb/tools/SignedFloodFill.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace vdbounce {
namespace {

constexpr std::size_t kRegionsPerTask = 16;
constexpr std::size_t kLeavesPerTask = 4;

using Inside = std::vector<std::array<bool, BandLeaf::kVoxels>>;

void validate(const MeshToLevelSetOptions& options)
{
    const auto require = [](bool good, const char* name, double value, const char* remedy) {
        if (!good) throw UsageError(name, numberText(value) + " is out of range", remedy);
    };
    require(options.voxelSize > 0.0 && std::isfinite(options.voxelSize), "voxel size", options.voxelSize,
            "give a positive length");
    require(options.exteriorVx >= 1.0 && options.exteriorVx < 1e6, "exterior band", options.exteriorVx,
            "give at least 1 voxel");
    require(options.interiorVx >= 1.0 && options.interiorVx < 1e6, "interior band", options.interiorVx,
            "give at least 1 voxel");
    require(options.thicknessVx > 0.0 && options.thicknessVx < 1e6, "thickness", options.thicknessVx,
            "give a positive number of voxels");
}

bool insideAt(const MeshTree& tree, SignMethod sign, const Vec3d& point)
{
    return sign == SignMethod::Parity ? tree.insideByParity(point) : tree.windingNumber(point) > 0.5;
}

// Asks once for each region. What flood leaves open, the slivers of voxels close to the mesh, winding decides.
Inside insideByRegions(const std::vector<BandLeaf>& leaves, const MeshTree& tree, SignMethod sign, double voxelSize)
{
    const SpaceRegions space(leaves, voxelSize);
    const auto& regions = space.regions();
    std::vector<char> regionInside(regions.size());
    forEachIndex(regions.size(), kRegionsPerTask, [&](std::size_t r) {
        const auto& region = regions[r];
        if (sign == SignMethod::Flood && region.depth > voxelSize) {
            regionInside[r] = region.outermost ? 0 : 1;
        } else {
            const Vec3d point = leaves[region.deepestLeaf].voxel(region.deepestVoxel).cast<double>() * voxelSize;
            regionInside[r] = insideAt(tree, sign, point) ? 1 : 0;
        }
    });
    Inside inside(leaves.size());
    for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf) {
        for (int v = 0; v < BandLeaf::kVoxels; ++v)
            inside[leaf][std::size_t(v)] = regionInside[space.regionOf(leaf, v)] != 0;
    }
    return inside;
}

// Through a hole inside and outside are one region, so every voxel is asked for itself.
Inside insideByVoxels(const std::vector<BandLeaf>& leaves, const MeshTree& tree, SignMethod sign, double voxelSize,
                      Progress& progress)
{
    Inside inside(leaves.size());
    forEachIndex(leaves.size(), kLeavesPerTask, [&](std::size_t leaf) {
        throwIfStopped(progress);
        for (int v = 0; v < BandLeaf::kVoxels; ++v) {
            inside[leaf][std::size_t(v)] = insideAt(tree, sign, leaves[leaf].voxel(v).cast<double>() * voxelSize);
        }
    });
    return inside;
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

std::vector<std::string> warnAboutEdges(const EdgeReport& edges, SignMethod sign)
{
    std::vector<std::string> warnings;
    if (edges.open > 0) {
        warnings.push_back("the mesh is open (" + std::to_string(edges.open) +
                           " edges with one triangle): the sign across its holes is the " + signMethodName(sign) +
                           " method's guess, and phi jumps there; close the mesh, or use --sign unsigned for a sheet");
    }
    if (edges.inconsistent > 0) {
        warnings.push_back(std::to_string(edges.inconsistent) +
                           " edges join triangles that face opposite ways; orient the mesh or try --sign parity");
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
    const Inside inside = edges.open == 0 || sign == SignMethod::Flood
                              ? insideByRegions(leaves, tree, sign, options.voxelSize)
                              : insideByVoxels(leaves, tree, sign, options.voxelSize, progress);
    auto grid = assemble(leaves, band, options, [&](std::size_t leaf, int v) {
        const float distance = leaves[leaf].distance[std::size_t(v)];
        return inside[leaf][std::size_t(v)] ? -distance : distance;
    });
    openvdb::tools::signedFloodFillWithValues(grid->tree(), band.exterior, -band.interior);
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
    result.sign = options.sign == SignMethod::Auto ? SignMethod::Winding : options.sign;
    const EdgeReport edges = inspectEdges(mesh);
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
