// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/inside.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/build/space_regions.h"

#include <algorithm>

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
    InsideFinder(const std::vector<BandLeaf>& leaves, const MeshTree& tree, InsideTest test, double voxelSize)
        : leaves_(leaves), tree_(tree), test_(test), voxelSize_(voxelSize), space_(leaves, voxelSize)
    {
    }

    InsideFlags find(bool closed, const Progress& progress)
    {
        if (!closed && test_ != InsideTest::Flood) chooseWitnesses();
        sides_.resize(space_.regions().size());
        forEachIndex(sides_.size(), kRegionsPerTask, [&](std::size_t region) {
            throwIfStopped(progress);
            sides_[region] = sideOf(region);
        });
        InsideFlags inside(leaves_.size());
        forEachIndex(leaves_.size(), kLeavesPerTask, [&](std::size_t leaf) {
            throwIfStopped(progress);
            for (int v = 0; v < BandLeaf::kVoxels; ++v) {
                const Side side = sides_[space_.regionOf(leaf, v)];
                inside[leaf][std::size_t(v)] = side == Side::Mixed ? isInside(leaf, v) : side == Side::Inside;
            }
        });
        return inside;
    }

private:
    struct Voxel {
        std::size_t leaf;
        int voxel;
    };

    bool isInside(std::size_t leaf, int voxel) const
    {
        const Vec3d point = leaves_[leaf].voxel(voxel).cast<double>() * voxelSize_;
        return test_ == InsideTest::Parity ? tree_.insideByParity(point) : tree_.windingNumber(point) > 0.5;
    }

    Side sideOf(std::size_t number) const
    {
        const SpaceRegions::Region& region = space_.regions()[number];
        if (test_ == InsideTest::Flood && region.depth > float(voxelSize_)) {
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

    const std::vector<BandLeaf>& leaves_;
    const MeshTree& tree_;
    const InsideTest test_;
    const double voxelSize_;
    const SpaceRegions space_;
    std::vector<std::vector<Voxel>> witnesses_;
    std::vector<Side> sides_;
};

} // namespace

InsideFlags findInside(const std::vector<BandLeaf>& leaves, const MeshTree& tree, InsideTest test, bool closed,
                       double voxelSize, const Progress& progress)
{
    return InsideFinder(leaves, tree, test, voxelSize).find(closed, progress);
}

} // namespace vdbounce
