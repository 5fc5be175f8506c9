// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/mesh_to_level_set.h"

#include "vdbounce/base/memory_limit.h"
#include "vdbounce/base/voxel_limits.h"
#include "vdbounce/build/conversion_estimate.h"
#include "vdbounce/build/inside.h"
#include "vdbounce/build/leaf_union.h"
#include "vdbounce/build/level_set_assembly.h"
#include "vdbounce/build/mesh_warnings.h"
#include "vdbounce/build/sign_choice.h"
#include "vdbounce/build/space_regions.h"
#include "vdbounce/field/band_width.h"
#include "vdbounce/field/grid_assembly.h"
#include "vdbounce/field/option_checks.h"

#include <algorithm>
#include <numeric>

namespace vdbounce {
namespace {

// A leaf of numbers and the leaf of the grid that they become; confidences are held where there are doubts only.
constexpr double kBytesOfClosest = 4200.0;
constexpr double kBytesOfConfidence = 2200.0;

void validate(const MeshToLevelSetOptions& options)
{
    requireVoxelSize(options.transform ? options.transform->smallestVoxelSize() : options.voxelSize, "mesh");
    requireBand("exterior band", options.exteriorVx);
    requireBand("interior band", options.interiorVx);
    requireInRange(options.thicknessVx > 0.0 && options.thicknessVx < kWidestBandVx, "thickness", options.thicknessVx,
                   "give a positive number of voxels");
}

using TriangleNumbers = std::vector<std::uint32_t>;

TriangleNumbers allTriangles(const TriangleMesh& mesh)
{
    TriangleNumbers all(mesh.triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    return all;
}

// One conversion, from the mesh to the grids.
class Conversion {
public:
    Conversion(const TriangleMesh& mesh, const MeshToLevelSetOptions& options, TopologyMemory* memory,
               Progress& progress)
        : mesh_(mesh), options_(options), memory_(memory), progress_(progress),
          transform_(options.transform ? *options.transform
                                       : LinearTransform(options.voxelSize * Mat3d::Identity(), Vec3d::Zero())),
          voxel_(transform_.voxelSize().maxCoeff()), exterior_(options.exteriorVx * voxel_),
          interior_(options.interiorVx * voxel_), halfSheet_(0.5 * options.thicknessVx * voxel_)
    {
    }

    ConversionEstimate expect() const
    {
        const double beside =
            (options_.closest ? kBytesOfClosest : 0.0) + (options_.confidence ? kBytesOfConfidence : 0.0);
        requireConvertible(mesh_, transform_, exterior_, interior_, maxMemory(), beside);
        return estimateConversion(mesh_, transform_, exterior_, interior_, beside);
    }

    MeshToLevelSetResult run()
    {
        expect();
        throwIfStopped(progress_);
        result_.sign = options_.sign;
        switch (options_.sign) {
        case SignMethod::Auto: automatic(); break;
        case SignMethod::Winding: asWhole(/*parity=*/false); break;
        case SignMethod::Parity: asWhole(/*parity=*/true); break;
        case SignMethod::Flood: byRegions(allTriangles(mesh_), InsideTest::Flood, true); break;
        case SignMethod::Unsigned: sheets_ = measureSheets(allTriangles(mesh_)); break;
        }
        return finish();
    }

private:
    std::uint64_t maxMemory() const { return options_.maxMemory > 0 ? options_.maxMemory : defaultMaxMemory(); }

    void automatic()
    {
        const double torn = kTornVx * transform_.smallestVoxelSize();
        MeshTopology topology = memory_ != nullptr ? memory_->find(mesh_, torn) : findTopologyMended(mesh_, torn);
        throwIfStopped(progress_);
        const ComponentSigns signs = chooseSigns(topology, mesh_.points, transform_.smallestVoxelSize(), progress_);
        result_.sign = signs.overall;
        result_.choices = signs.choices;
        warnAboutMesh(topology, signs, options_.thicknessVx, result_.warnings);
        const std::vector<char> sheet = signs.having(SignMethod::Unsigned);
        const std::vector<std::uint32_t> sheetTriangles = trianglesOf(topology, sheet);
        if (!sheetTriangles.empty()) sheets_ = measureSheets(sheetTriangles);
        std::vector<char> solid(sheet.size());
        std::transform(sheet.begin(), sheet.end(), solid.begin(), [](char flag) { return char(1 - flag); });
        // Where there are no sheets, triangles that are no part of a body's surface count for the distance all the
        // same.
        const std::vector<std::uint32_t> solidTriangles =
            sheetTriangles.empty() ? allTriangles(mesh_) : trianglesOf(topology, solid);
        if (solidTriangles.empty()) return;
        if (signs.needsRays(topology)) return byRegions(solidTriangles, InsideTest::Parity, false);
        byColumns(solidTriangles, groupSolids(std::move(topology), mesh_.points, solid), true);
    }

    // All triangles as the file has them, as one body.
    void asWhole(bool parity)
    {
        MeshTopology topology = findTopologyAsIs(mesh_);
        warnAboutMesh(topology, options_.sign, result_.warnings);
        if (parity) {
            if (topology.components.front().openEdges > 0)
                return byRegions(allTriangles(mesh_), InsideTest::Parity, false);
            // Whichever way its faces look, they are not asked.
            topology.components.front().orientable = topology.components.front().bounded = false;
        }
        SolidGroups solids = groupSolids(std::move(topology), mesh_.points, {1});
        // Asked for by name, it is the winding number itself that decides, beside holes too.
        for (SolidGroup& group : solids.groups) group.capsAreWalls = false;
        byColumns(allTriangles(mesh_), std::move(solids), false);
    }

    void byColumns(const TriangleNumbers& triangles, SolidGroups solids, bool cavities)
    {
        const std::vector<Crossing> crossings = findCrossings(solids.mesh, transform_, progress_);
        if (cavities) warnAboutCavities(findCavities(solids, crossings, transform_, progress_), result_.warnings);
        solids.mesh = ClosedMesh(); // not to be held beside the leaves
        leaves_ = measure(triangles, std::max(exterior_, interior_));
        addMissingLeaves(sheets_, leaves_);
        signs_ = signByColumns(leaves_, solids, crossings, transform_, options_.confidence, progress_);
        warnAboutDoubt(signs_, cavities, result_.warnings);
        addSplitLeaves();
        result_.doubtfulVoxels = signs_.holes.voxels + signs_.overlaps.voxels;
    }

    void byRegions(const TriangleNumbers& triangles, InsideTest test, bool closed)
    {
        leaves_ = measure(triangles, std::max(exterior_, interior_));
        addMissingLeaves(sheets_, leaves_);
        requireLatticeFits(leaves_, maxMemory());
        const TriangleMesh part = partOf(mesh_, triangles);
        const MeshTree tree(part);
        throwIfStopped(progress_);
        signs_.inside = signByRegions(leaves_, tree, test, closed, transform_, progress_);
        if (options_.confidence) askRaysForConfidence(leaves_, tree, transform_, progress_);
    }

    // They hold nothing of the band, but both sides.
    void addSplitLeaves()
    {
        BandLeaves split;
        for (const SplitLeaf& part : signs_.split) {
            split.push_back(emptyLeaf(part.leaf, options_.closest));
            for (std::size_t v = 0; v < part.inside.size(); ++v) {
                if (part.inside[v]) split.back()->distance[v] = -split.back()->distance[v];
            }
        }
        addLeaves(std::move(split), leaves_);
    }

    BandLeaves measure(const TriangleNumbers& triangles, double band)
    {
        return measureBandLeaves(mesh_, triangles, transform_, band, options_.closest, progress_);
    }

    BandLeaves measureSheets(const TriangleNumbers& triangles)
    {
        BandLeaves leaves = measure(triangles, exterior_ + halfSheet_);
        thicken(leaves, float(halfSheet_));
        return leaves;
    }

    MeshToLevelSetResult finish()
    {
        BandWidths band{bandWidth(exterior_), bandWidth(interior_)};
        if (leaves_.empty()) {
            band.interior = float(halfSheet_);
            leaves_ = std::move(sheets_);
        } else if (!sheets_.empty()) {
            band.interior = std::max(band.interior, float(halfSheet_));
            unite(leaves_, sheets_);
        }
        throwIfStopped(progress_);
        AssembledGrids grids = assembleLevelSet(std::move(leaves_), signs_.inside, transform_, band, options_.gridName,
                                                options_.confidence);
        result_.grid = std::move(grids.levelSet);
        result_.closest = std::move(grids.closest);
        result_.confidence = std::move(grids.confidence);
        return std::move(result_);
    }

    const TriangleMesh& mesh_;
    const MeshToLevelSetOptions& options_;
    TopologyMemory* const memory_; // null where nothing is kept
    Progress& progress_;
    const LinearTransform transform_;
    const double voxel_; // the longest side, world
    const double exterior_;
    const double interior_;
    const double halfSheet_;
    BandLeaves leaves_;
    BandLeaves sheets_;
    ColumnSigns signs_;
    MeshToLevelSetResult result_;
};

} // namespace

MeshToLevelSetResult meshToLevelSet(const TriangleMesh& mesh, const MeshToLevelSetOptions& options, Progress& progress)
{
    validate(options);
    return Conversion(mesh, options, nullptr, progress).run();
}

MeshToLevelSetResult meshToLevelSet(const TriangleMesh& mesh, const MeshToLevelSetOptions& options,
                                    TopologyMemory& memory, Progress& progress)
{
    validate(options);
    return Conversion(mesh, options, &memory, progress).run();
}

ConversionEstimate expectConversion(const TriangleMesh& mesh, const MeshToLevelSetOptions& options)
{
    validate(options);
    return Conversion(mesh, options, nullptr, Progress::none()).expect();
}

} // namespace vdbounce
