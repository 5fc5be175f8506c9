// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/thin_features.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/field/openvdb_transform.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vdbounce {
namespace {

constexpr std::size_t kLeavesPerTask = 64;

// Of a wall's middle, wherever its voxels lie, it is 0.5 at most; a right angle has sqrt(1/2).
constexpr double kCancelled = 0.55;

using Kind = ThinFeatures::Kind;
using Leaf = openvdb::FloatTree::LeafNodeType;
using Accessor = openvdb::FloatGrid::ConstAccessor;

constexpr openvdb::Index kStrides[3] = {Leaf::DIM * Leaf::DIM, Leaf::DIM, 1};

// Known thicknesses come before places without one.
void add(Kind& sum, const Kind& part)
{
    if (part.voxels > 0 &&
        (sum.voxels == 0 || (part.thinnest > 0.0 && (sum.thinnest == 0.0 || part.thinnest < sum.thinnest)))) {
        sum.thinnest = part.thinnest;
        sum.place = part.place;
    }
    sum.voxels += part.voxels;
}

void add(ThinFeatures::Smallest& smallest, const ThinFeatures::Smallest& other)
{
    if (other.thickness > 0.0 && (smallest.thickness == 0.0 || other.thickness < smallest.thickness)) smallest = other;
}

struct Features : ThinFeatures {
    Features& operator+=(const Features& other)
    {
        add(walls, other.walls);
        add(gaps, other.gaps);
        add(smallest, other.smallest);
        return *this;
    }
};

// A voxel's value and its six neighbours'.
struct Cross {
    double middle;
    double before[3];
    double after[3];

    double bend(int axis) const { return before[axis] + after[axis] - 2.0 * middle; }
    double bend() const { return bend(0) + bend(1) + bend(2); }
};

// Neighbours in the same leaf are read from it, the others through `accessor`.
Cross crossAt(const Leaf& leaf, openvdb::Index offset, Accessor& accessor)
{
    const float* values = leaf.buffer().data();
    const openvdb::Coord voxel = leaf.offsetToGlobalCoord(offset);
    Cross cross{double(values[offset]), {}, {}};
    for (int axis = 0; axis < 3; ++axis) {
        const openvdb::Index place = offset / kStrides[axis] % Leaf::DIM;
        openvdb::Coord step(0);
        step[axis] = 1;
        cross.before[axis] = place > 0 ? values[offset - kStrides[axis]] : accessor.getValue(voxel - step);
        cross.after[axis] = place + 1 < Leaf::DIM ? values[offset + kStrides[axis]] : accessor.getValue(voxel + step);
    }
    return cross;
}

int mostBentAxis(const Cross& cross, double sign)
{
    int axis = 0;
    for (int other = 1; other < 3; ++other) {
        if (sign * cross.bend(other) > sign * cross.bend(axis)) axis = other;
    }
    return axis;
}

// A wall's middle is no further out than what is before and behind it. Beside values that are clamped to the band,
// which bend, too, it is.
bool isMiddle(const Cross& cross, double sign)
{
    const int axis = mostBentAxis(cross, sign);
    return std::min(sign * cross.before[axis], sign * cross.after[axis]) >= sign * cross.middle;
}

// How far the slope away from a wall, squared, may be from a distance's for its sides to count as parallel.
constexpr double kParallel = 0.2;

// Of the wall whose middle the voxel is near: along the axis that it bends most, one neighbour is on its side and the
// other one across, and the three values add up to the wall's thickness. 0 where the wall ends: there phi rises along
// it, too. Of gaps with all signs changed.
double thicknessOf(const Cross& cross, double sign, const LinearTransform& transform)
{
    const int axis = mostBentAxis(cross, sign);
    Vec3d slope; // away from the wall
    for (int other = 0; other < 3; ++other) {
        slope[other] =
            std::max(std::abs(cross.before[other] - cross.middle), std::abs(cross.after[other] - cross.middle));
    }
    // With sheared axes slopes do not add up like this, and the thickness is taken as it is.
    const double slope2 = slope.cwiseQuotient(transform.voxelSize()).squaredNorm();
    if (transform.orthogonal() && std::abs(slope2 - 1.0) > kParallel) return 0.0;
    const double near = std::min(sign * cross.before[axis], sign * cross.after[axis]);
    const double far = std::max(sign * cross.before[axis], sign * cross.after[axis]);
    return std::max(0.0, far - near - 2.0 * sign * cross.middle);
}

class Search {
public:
    explicit Search(const openvdb::FloatGrid& grid)
        : transform_(toLinearTransform(grid.transform())), side_(float(transform_.smallestVoxelSize())),
          perTwoSides2_((2.0 * transform_.voxelSize()).array().square().inverse()),
          box_(grid.evalActiveVoxelBoundingBox())
    {
        // Voxels beside the box know nothing, so that those in its sides tell nothing.
        if (!box_.empty()) box_.expand(-1);
    }

    void lookAt(const Leaf& leaf, Accessor& accessor, Features& features) const
    {
        const float* values = leaf.buffer().data();
        for (openvdb::Index v = 0; v < Leaf::SIZE; ++v) {
            if (std::abs(values[v]) < side_ || leaf.isValueOn(v)) lookAt(leaf, v, accessor, features);
        }
    }

private:
    // Beside a plain surface, as most voxels are, one axis within the leaf shows as much.
    bool isPlain(const Leaf& leaf, openvdb::Index offset) const
    {
        if (!transform_.orthogonal()) return false;
        const float* values = leaf.buffer().data();
        double slope2 = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            const openvdb::Index place = offset / kStrides[axis] % Leaf::DIM;
            if (place == 0 || place + 1 == Leaf::DIM) continue;
            const double rise = double(values[offset + kStrides[axis]]) - double(values[offset - kStrides[axis]]);
            slope2 += rise * rise * perTwoSides2_[axis];
        }
        return slope2 >= kCancelled * kCancelled;
    }

    void lookAt(const Leaf& leaf, openvdb::Index offset, Accessor& accessor, Features& features) const
    {
        if (isPlain(leaf, offset)) return;
        const Cross cross = crossAt(leaf, offset, accessor);
        Vec3d gradient;
        for (int axis = 0; axis < 3; ++axis) gradient[axis] = 0.5 * (cross.after[axis] - cross.before[axis]);
        if (!(transform_.gradientToWorld(gradient).norm() < kCancelled)) return;
        const openvdb::Coord voxel = leaf.offsetToGlobalCoord(offset);
        if (box_.empty() || !box_.isInside(voxel)) return;
        const bool wall = cross.bend() > 0.0;
        const double sign = wall ? 1.0 : -1.0;
        const double thickness = thicknessOf(cross, sign, transform_);
        const Vec3d place = transform_.toWorld(Vec3d(double(voxel.x()), double(voxel.y()), double(voxel.z())));
        if (isMiddle(cross, sign)) add(features.smallest, {thickness, wall, place});
        if (std::abs(cross.middle) < side_) add(wall ? features.walls : features.gaps, {1, thickness, place});
    }

    const LinearTransform transform_;
    const float side_;
    const Vec3d perTwoSides2_; // one over a central difference's way, squared
    openvdb::CoordBBox box_;
};

} // namespace

ThinFeatures thinFeatures(const LevelSetGrid& handle)
{
    const openvdb::FloatGrid& grid = toOpenVdb(handle);
    const Search search(grid);
    std::vector<const Leaf*> leaves;
    grid.tree().getNodes(leaves);
    return reduceBlocks(leaves.size(), kLeavesPerTask, Features{}, [&](IndexRange range) {
        Features part;
        Accessor accessor = grid.getConstAccessor();
        for (std::size_t i = range.begin; i < range.end; ++i) search.lookAt(*leaves[i], accessor, part);
        return part;
    });
}

} // namespace vdbounce
