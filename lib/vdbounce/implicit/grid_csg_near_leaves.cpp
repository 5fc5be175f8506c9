// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/grid_csg_near_leaves.h"

#include <cmath>

namespace vdbounce {
namespace {

constexpr int kLeafSide = BlockLayout::kLeafSide;
constexpr int kNodeBits = 7; // 128 voxels a side
constexpr int kNodeMask = (1 << kNodeBits) - 1;

// A block's cells reach from its first voxel to the one after its last, index space of the field.
constexpr double kHalfBlock = 0.5 * kLeafSide;
// A leaf's voxels, from the first one's centre to the last one's.
constexpr double kHalfLeaf = 0.5 * (kLeafSide - 1);
// Above what mapping back and forth may be off, voxels.
constexpr double kRounding = 1e-6;

class Marking {
public:
    Marking(const DistanceField& field, const LinearTransform& onto) : field_(field), onto_(onto)
    {
        const Mat3d toTarget = onto.worldToIndex() * field.transform().indexToWorld();
        blockReach_ = kHalfBlock * toTarget.cwiseAbs().rowwise().sum();
        leafReach_ = kHalfLeaf * (field.transform().worldToIndex() * onto.indexToWorld()).cwiseAbs().rowwise().sum();
    }

    // Both boxes around each other's cubes must meet, which leaves few that do not.
    void markAround(const Vec3i& block)
    {
        const Vec3d centre = block.cast<double>().array() + kHalfBlock;
        const Vec3d at = onto_.toIndex(field_.transform().toWorld(centre));
        const Vec3i first = leafOf(at - blockReach_);
        const Vec3i last = leafOf(at + blockReach_);
        for (int x = first.x(); x <= last.x(); ++x) {
            for (int y = first.y(); y <= last.y(); ++y) {
                for (int z = first.z(); z <= last.z(); ++z) {
                    const Vec3i leaf = kLeafSide * Vec3i(x, y, z);
                    const Vec3d middle = leaf.cast<double>().array() + kHalfLeaf;
                    const Vec3d apart = field_.transform().toIndex(onto_.toWorld(middle)) - centre;
                    if ((apart.cwiseAbs() - leafReach_).maxCoeff() <= kHalfBlock + kRounding) mark(leaf);
                }
            }
        }
    }

    NearLeaves take() { return std::move(near_); }

private:
    static Vec3i leafOf(const Vec3d& voxel) { return (voxel.array() / kLeafSide).floor().cast<int>(); }

    void mark(const Vec3i& leaf)
    {
        const LowerNodePlace place{leaf.x() & ~kNodeMask, leaf.y() & ~kNodeMask, leaf.z() & ~kNodeMask};
        if (latest_ == nullptr || place < latestPlace_ || latestPlace_ < place) {
            latest_ = &near_[place];
            latestPlace_ = place;
        }
        const auto entry = [](int voxel) { return std::size_t(voxel & kNodeMask) / kLeafSide; };
        latest_->set((entry(leaf.x()) * 16 + entry(leaf.y())) * 16 + entry(leaf.z()));
    }

    const DistanceField& field_;
    const LinearTransform& onto_;
    Vec3d blockReach_; // half a block's box in the target's index space
    Vec3d leafReach_;  // half a leaf's box in the field's
    NearLeaves near_;
    LeafBits* latest_ = nullptr;
    LowerNodePlace latestPlace_{};
};

} // namespace

NearLeaves leavesNearBlocks(const DistanceField& field, const LinearTransform& onto)
{
    Marking marking(field, onto);
    for (const Vec3i& block : field.blocks().origins()) marking.markAround(block);
    return marking.take();
}

} // namespace vdbounce
