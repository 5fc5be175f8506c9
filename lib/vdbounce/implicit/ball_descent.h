// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"
#include "vdbounce/base/progress.h"
#include "vdbounce/implicit/ball_list.h"
#include "vdbounce/implicit/ball_reach.h"

namespace vdbounce {

/// A cube of 8^3 leaves, 2^level of them on a side, at a multiple of its side.
struct LeafCube {
    static constexpr int kLeafSide = 8; ///< voxels

    Vec3i leaf; ///< the lowest, leaf coordinates: voxel coordinates over 8
    int level;

    int side() const { return 1 << level; } ///< leaves

    /// Around the centres of its voxels, index space.
    Box voxels() const
    {
        Box box;
        box.min = leaf.cast<double>() * kLeafSide;
        box.max = box.min + Vec3d::Constant(double(kLeafSide) * side() - 1.0);
        return box;
    }
};

/// What is done with the balls that matter to a part of space. Called from many threads.
class BallWork {
public:
    virtual ~BallWork() = default;

    /// True where all of a cube is the same and has been seen to, so that nobody need look at its parts.
    virtual bool settled(const LeafCube& cube, const Ball* balls, std::size_t count) = 0;

    /// A leaf, and all the balls that reach one of its voxels, in the order of the list, with some that nearly do.
    virtual void leaf(const Vec3i& leaf, const Ball* balls, std::size_t count) = 0;
};

/// Shows every leaf within reach of some balls to `work`, in any order.
///
/// Method: the cube around all is halved again and again, each part with its balls, down to the leaves; where the balls
/// of a part lie in a corner of it, that corner comes next. So empty space costs nothing, however far a stray ball
/// is, nor does the inside of balls of a thousand voxels that `work` settles. Lists keep their order. All balls must
/// be finite and within 2^30 voxels of the origin with their reach.
///
/// Cost: about 60 nanoseconds a ball where balls are some voxels large, and 70 bytes a ball beside the list itself.
/// Throws Interrupted.
void visitLeaves(BallList balls, const BallReach& reach, BallWork& work, Progress& progress);

} // namespace vdbounce
