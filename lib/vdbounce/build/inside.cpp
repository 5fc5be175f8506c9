// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/inside.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/build/space_regions.h"

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

constexpr std::size_t kRegionsPerTask = 16;
constexpr std::size_t kLeavesPerTask = 4;

// Voxels of a region that are asked before it is believed to be all on one side. A hole through which a region leaks
// puts a good part of it, not a few voxels, on the other side.
constexpr std::size_t kWitnesses = 48;

enum class Side : char { Outside, Inside, Mixed };

class InsideFinder {
public:
    InsideFinder(BandLeaves& leaves, const MeshTree& tree, InsideTest test, const LinearTransform& transform)
        : leaves_(leaves), tree_(tree), test_(test), transform_(transform), space_(leaves, transform.voxelSize())
    {
    }

    std::vector<InsideRun> find(bool closed, const Progress& progress)
    {
        if (!closed && test_ != InsideTest::Flood) chooseWitnesses();
        sides_.resize(space_.regions().size());
        forEachIndex(sides_.size(), kRegionsPerTask, [&](std::size_t region) {
            throwIfStopped(progress);
            sides_[region] = sideOf(region);
        });
        forEachIndex(leaves_.size(), kLeavesPerTask, [&](std::size_t leaf) {
            throwIfStopped(progress);
            for (int v = 0; v < BandLeaf::kVoxels; ++v) {
                const Side side = sides_[space_.regionOf(leaf, v)];
                float& distance = leaves_[leaf]->distance[std::size_t(v)];
                const bool inside = side == Side::Mixed ? isInside(leaf, v) : side == Side::Inside;
                if (inside && distance > 0.0f) distance = -distance;
            }
        });
        return findEmptyLeaves(progress);
    }

private:
    struct Voxel {
        std::size_t leaf;
        int voxel;
    };

    // In the order of the lattice.
    std::vector<InsideRun> findEmptyLeaves(const Progress& progress) const
    {
        const auto& empty = space_.emptyLeaves();
        std::vector<char> inside(empty.size());
        forEachIndex(empty.size(), kRegionsPerTask, [&](std::size_t i) {
            throwIfStopped(progress);
            const Side side = sides_[empty[i].region];
            const Vec3d middle =
                transform_.toWorld(empty[i].leaf.cast<double>() * BandLeaf::kSide + Vec3d::Constant(3.5));
            inside[i] = (side == Side::Mixed ? tree_.insideByParity(middle) : side == Side::Inside) ? 1 : 0;
        });
        std::vector<InsideRun> runs;
        for (std::size_t i = 0; i < empty.size(); ++i) {
            const Vec3i& leaf = empty[i].leaf;
            if (inside[i] != 0) runs.push_back({leaf.x(), leaf.y(), leaf.z(), leaf.z() + 1});
        }
        return runs;
    }

    bool isInside(std::size_t leaf, int voxel) const
    {
        return tree_.insideByParity(transform_.toWorld(leaves_[leaf]->voxel(voxel).cast<double>()));
    }

    Side sideOf(std::size_t number) const
    {
        const SpaceRegions::Region& region = space_.regions()[number];
        if (test_ == InsideTest::Flood && region.depth > float(transform_.voxelSize().maxCoeff())) {
            return region.outermost ? Side::Outside : Side::Inside;
        }
        const bool inside = isInside(region.deepestLeaf, region.deepestVoxel);
        if (!witnesses_.empty()) {
            for (const Voxel& witness : witnesses_[number]) {
                if (isInside(witness.leaf, witness.voxel) != inside) return Side::Mixed;
            }
        }
        return inside ? Side::Inside : Side::Outside;
    }

    // Evenly over each region's voxels, in the order of the leaves.
    void chooseWitnesses()
    {
        std::vector<std::size_t> sizes(space_.regions().size());
        std::vector<std::size_t> seen(sizes.size());
        forEachVoxel([&](std::uint32_t region, Voxel) { ++sizes[region]; });
        witnesses_.resize(sizes.size());
        forEachVoxel([&](std::uint32_t region, Voxel voxel) {
            const std::size_t stride = std::max<std::size_t>(1, sizes[region] / kWitnesses);
            if (seen[region]++ % stride == 0) witnesses_[region].push_back(voxel);
        });
    }

    template <class Body> void forEachVoxel(const Body& body) const
    {
        for (std::size_t leaf = 0; leaf < leaves_.size(); ++leaf) {
            for (int v = 0; v < BandLeaf::kVoxels; ++v) body(space_.regionOf(leaf, v), Voxel{leaf, v});
        }
    }

    BandLeaves& leaves_;
    const MeshTree& tree_;
    const InsideTest test_;
    const LinearTransform& transform_;
    const SpaceRegions space_;
    std::vector<std::vector<Voxel>> witnesses_;
    std::vector<Side> sides_;
};

} // namespace

std::vector<InsideRun> signByRegions(BandLeaves& leaves, const MeshTree& tree, InsideTest test, bool closed,
                                     const LinearTransform& transform, const Progress& progress)
{
    return InsideFinder(leaves, tree, test, transform).find(closed, progress);
}

void askRaysForConfidence(BandLeaves& leaves, const MeshTree& tree, const LinearTransform& transform,
                          const Progress& progress)
{
    forEachIndex(leaves.size(), kLeavesPerTask, [&](std::size_t i) {
        throwIfStopped(progress);
        BandLeaf& leaf = *leaves[i];
        leaf.confidence = std::make_unique<LeafArray<float>>();
        for (int v = 0; v < BandLeaf::kVoxels; ++v) {
            float& sure = (*leaf.confidence)[std::size_t(v)];
            sure = 1.0f;
            if (!std::isfinite(leaf.distance[std::size_t(v)])) continue;
            const int inside = tree.raysInside(transform.toWorld(leaf.voxel(v).cast<double>()));
            sure = std::abs(2.0f * float(inside) / float(MeshTree::kRays) - 1.0f);
        }
    });
}

} // namespace vdbounce
