// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/sample_field.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/voxel_limits.h"
#include "vdbounce/field/band_width.h"
#include "vdbounce/field/grid_assembly.h"
#include "vdbounce/field/option_checks.h"
#include "vdbounce/implicit/band_cubes.h"
#include "vdbounce/implicit/leaf_limit.h"
#include "vdbounce/io/vdb_archive.h"

#include <openvdb/tools/Prune.h>

namespace vdbounce {
namespace {

constexpr std::size_t kLeavesPerReport = 1024;

using Tree = openvdb::FloatTree;
using Leaf = Tree::LeafNodeType;

openvdb::Coord toCoord(const Vec3i& voxel) { return {voxel.x(), voxel.y(), voxel.z()}; }

void validate(const SampleFieldOptions& options)
{
    requireVoxelSize(options.transform ? options.transform->smallestVoxelSize() : options.voxelSize, "shape");
    requireBand("exterior band", options.exteriorVx);
    requireBand("interior band", options.interiorVx);
}

LinearTransform transformFor(const SampleFieldOptions& options)
{
    return options.transform ? *options.transform
                             : LinearTransform(options.voxelSize * Mat3d::Identity(), Vec3d::Zero());
}

// The voxels that may be in the band.
VoxelBox voxelsWithin(const Box& world, const LinearTransform& transform)
{
    Box index;
    for (int corner = 0; corner < 8; ++corner) {
        index.add(transform.toIndex(Vec3d((corner & 1) != 0 ? world.max.x() : world.min.x(),
                                          (corner & 2) != 0 ? world.max.y() : world.min.y(),
                                          (corner & 4) != 0 ? world.max.z() : world.min.z())));
    }
    const double farthest = std::max(index.min.cwiseAbs().maxCoeff(), index.max.cwiseAbs().maxCoeff());
    if (!(farthest < kFarthestVoxel)) refuseFarVoxels(transform.smallestVoxelSize(), farthest, "what", "it");
    return {index.min.array().ceil().cast<int>(), index.max.array().floor().cast<int>()};
}

Box boxToSample(const ImplicitField& field, const SampleFieldOptions& options, double exterior)
{
    Box box = field.box();
    box.min -= Vec3d::Constant(exterior);
    box.max += Vec3d::Constant(exterior);
    if (options.within) {
        if (options.within->empty() || !options.within->size().allFinite())
            throw UsageError("the box to sample within", "is empty or not finite", "give min below max");
        box.min = box.min.cwiseMax(options.within->min);
        box.max = box.max.cwiseMin(options.within->max);
    }
    if (!box.empty() && !box.size().allFinite())
        throw UsageError("the field", "has no end", "give the box within which to sample it");
    return box;
}

class Sampling {
public:
    Sampling(const ImplicitField& field, const SampleFieldOptions& options, const LinearTransform& transform,
             Progress& progress)
        : field_(field), options_(options), transform_(transform),
          exterior_(bandWidth(options.exteriorVx * transform.voxelSize().maxCoeff())),
          interior_(bandWidth(options.interiorVx * transform.voxelSize().maxCoeff())), progress_(progress),
          within_(voxels())
    {
    }

    openvdb::FloatGrid::Ptr run()
    {
        const BandCubes cubes = findBandCubes(
            field_, transform_,
            {exterior_, interior_, options_.time, within_, leavesWithin(options_.maxMemory, kBytesPerLeaf)});
        auto grid = makeGrid<openvdb::FloatGrid>(exterior_, transform_, options_.gridName);
        grid->setGridClass(openvdb::GRID_LEVEL_SET);
        ProgressCounter counter(progress_, cubes.leaves.size());
        for (const VoxelCube& cube : cubes.inside) fillInside(grid->tree(), cube);
        addLeaves(*grid, cubes.leaves.size(), [&](std::size_t i) {
            if (i % kLeavesPerReport == 0) counter.add(std::min(kLeavesPerReport, cubes.leaves.size() - i));
            return leafOf(cubes.leaves[i].origin);
        });
        openvdb::tools::prune(grid->tree());
        return grid;
    }

private:
    VoxelBox voxels() const
    {
        const Box box = boxToSample(field_, options_, exterior_);
        return box.empty() ? VoxelBox{Vec3i::Zero(), Vec3i::Constant(-1)} : voxelsWithin(box, transform_);
    }

    void fillInside(Tree& tree, const VoxelCube& cube) const
    {
        const Vec3i min = cube.origin.cwiseMax(within_.min);
        const Vec3i max = (cube.origin + Vec3i::Constant(cube.side - 1)).cwiseMin(within_.max);
        tree.sparseFill(openvdb::CoordBBox(toCoord(min), toCoord(max)), -interior_, /*active=*/false);
    }

    // Nothing where all of it is far outside.
    std::unique_ptr<Leaf> leafOf(const Vec3i& origin) const
    {
        auto leaf = std::make_unique<Leaf>(toCoord(origin), exterior_);
        float* values = leaf->buffer().data();
        Leaf::NodeMaskType active;
        bool anyInside = false;
        const Vec3d step = transform_.vectorToWorld(Vec3d::UnitZ());
        const bool cut = !within_.contains(VoxelCube{origin, int(Leaf::DIM)});
        for (openvdb::Index row = 0; row < Leaf::SIZE / Leaf::DIM; ++row) {
            const Vec3i first = origin + Vec3i(int(row >> Leaf::LOG2DIM), int(row % Leaf::DIM), 0);
            double phi[Leaf::DIM];
            field_.phiInRow(transform_.toWorld(first.cast<double>()), step, Leaf::DIM, options_.time, phi);
            for (openvdb::Index z = 0; z < Leaf::DIM; ++z) {
                const openvdb::Index v = row * Leaf::DIM + z;
                const float value = float(phi[z]);
                const bool beyond = cut && !within_.contains(Vec3i(first + Vec3i(0, 0, int(z))));
                const bool within = value < exterior_ && value > -interior_ && !beyond;
                values[v] = within ? value : (value > 0.0f || beyond ? exterior_ : -interior_);
                anyInside = anyInside || values[v] < 0.0f;
                if (within) active.setOn(v);
            }
        }
        if (!anyInside && active.isOff()) return nullptr;
        leaf->setValueMask(active);
        return leaf;
    }

    const ImplicitField& field_;
    const SampleFieldOptions& options_;
    const LinearTransform& transform_;
    const float exterior_; // world
    const float interior_;
    Progress& progress_;
    const VoxelBox within_;
};

} // namespace

LevelSetGrid sampleField(const ImplicitField& field, const SampleFieldOptions& options, Progress& progress)
{
    validate(options);
    const LinearTransform transform = transformFor(options);
    initializeOpenVdb();
    return toLevelSetGrid(Sampling(field, options, transform, progress).run(), options.gridName);
}

} // namespace vdbounce
