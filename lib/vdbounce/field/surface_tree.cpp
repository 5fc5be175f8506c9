// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/surface_tree.h"

#include "vdbounce/base/parallel.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vdbounce {
namespace {

// Values are rounded, to half precision at worst where a file is stored so.
constexpr double kRounding = 0x1p-10;

// The lowest 21 bits of a number, with two zeros between each and the next.
std::uint64_t spread(std::uint64_t bits)
{
    bits &= 0x1fffff;
    bits = (bits | bits << 32) & 0x1f00000000ffff;
    bits = (bits | bits << 16) & 0x1f0000ff0000ff;
    bits = (bits | bits << 8) & 0x100f00f00f00f00f;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
    return (bits | bits << 2) & 0x1249249249249249;
}

// Interleaves the bits of leaf coordinates, so that leaves that are close in order are close in space (Morton 1966).
std::uint64_t mortonCode(const Vec3i& leaf)
{
    return spread(std::uint64_t(leaf.x())) | spread(std::uint64_t(leaf.y())) << 1 |
           spread(std::uint64_t(leaf.z())) << 2;
}

int cubeOf(int x, int y, int z) { return x / 2 * 16 + y / 2 * 4 + z / 2; }

Vec3i voxelOf(int cube) { return Vec3i(cube / 16 * 2, cube / 4 % 4 * 2, cube % 4 * 2); }

} // namespace

struct SurfaceTree::Search {
    Vec3d point; // in the frame
    Cubes cubes;
    Cube best{Vec3i::Zero(), std::numeric_limits<double>::infinity()};
    double bestSquared = std::numeric_limits<double>::infinity();
};

SurfaceTree::Leaf SurfaceTree::leafOf(const float (&block)[BlockLayout::kSize], const Vec3i& origin,
                                      const Box& indexBox, const LinearTransform& transform, double error)
{
    const auto reach = float(0.5 * transform.voxelDiagonal() * (1.0 + kRounding) + error);
    // A voxel outside beside one inside is no farther from the surface than the two are from each other.
    const auto exitReach = float(transform.voxelSize().maxCoeff() * (1.0 + kRounding) + error);
    const float farthest = std::max(reach, exitReach);
    Leaf leaf{origin, 0, 0};
    for (int x = 0; x < BlockLayout::kLeafSide; ++x) {
        for (int y = 0; y < BlockLayout::kLeafSide; ++y) {
            const float* row = block + BlockLayout::kDiagonal + x * BlockLayout::kStrideX + y * BlockLayout::kStrideY;
            bool any = false; // most rows are done with by one vector comparison
            for (int z = 0; z < BlockLayout::kLeafSide; ++z) any |= std::abs(row[z]) <= farthest;
            for (int z = 0; any && z < BlockLayout::kLeafSide; ++z) {
                if (std::abs(row[z]) > farthest) continue;
                if (!indexBox.contains((origin + Vec3i(x, y, z)).cast<double>())) continue;
                const std::uint64_t bit = std::uint64_t(1) << cubeOf(x, y, z);
                if (std::abs(row[z]) <= reach) leaf.surface |= bit;
                if (row[z] > 0.0f && row[z] <= exitReach) leaf.exits |= bit;
            }
        }
    }
    return leaf;
}

SurfaceTree::SurfaceTree(const std::vector<Leaf>& leaves, const LinearTransform& transform)
{
    // A reflection leaves distances as they are, so the signs of the triangle's diagonal do not matter.
    const Eigen::HouseholderQR<Mat3d> qr(transform.indexToWorld());
    frame_ = qr.matrixQR().triangularView<Eigen::Upper>();
    for (int cube = 0; cube < 64; ++cube) cubeOffsets_[std::size_t(cube)] = frame_ * voxelOf(cube).cast<double>();
    cubeHalf_ = 0.5 * boxOfCubes(Vec3i::Zero(), Vec3i::Ones()).size();
    for (const Leaf& leaf : leaves) {
        if ((leaf.surface | leaf.exits) != 0) leaves_.push_back(leaf);
    }
    if (leaves_.empty()) return;
    sortLeaves();
    buildLevels();
}

void SurfaceTree::sortLeaves()
{
    const auto leafAt = [](const Leaf& leaf) {
        return Vec3i(leaf.origin.x() >> BlockLayout::kLeafBits, leaf.origin.y() >> BlockLayout::kLeafBits,
                     leaf.origin.z() >> BlockLayout::kLeafBits);
    };
    Vec3i low = leafAt(leaves_.front());
    for (const Leaf& leaf : leaves_) low = low.cwiseMin(leafAt(leaf));
    std::vector<std::pair<std::uint64_t, std::size_t>> order;
    order.reserve(leaves_.size());
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
        order.emplace_back(mortonCode(leafAt(leaves_[i]) - low), i);
    }
    std::sort(order.begin(), order.end());
    std::vector<Leaf> sorted;
    sorted.reserve(leaves_.size());
    for (const auto& [code, place] : order) sorted.push_back(leaves_[place]);
    leaves_ = std::move(sorted);
}

void SurfaceTree::buildLevels()
{
    levels_.emplace_back();
    for (const Leaf& leaf : leaves_) {
        Vec3i first = Vec3i::Constant(BlockLayout::kLeafSide);
        Vec3i last = Vec3i::Zero();
        for (std::uint64_t bits = leaf.surface | leaf.exits; bits != 0; bits &= bits - 1) {
            const int cube = __builtin_ctzll(bits);
            first = first.cwiseMin(voxelOf(cube));
            last = last.cwiseMax(voxelOf(cube) + Vec3i::Ones());
        }
        levels_.back().push_back(boxOfCubes(leaf.origin + first, leaf.origin + last));
    }
    while (levels_.back().size() > 1) {
        const std::vector<Box>& below = levels_.back();
        std::vector<Box> boxes(blockCount(below.size(), kChildren));
        for (std::size_t i = 0; i < below.size(); ++i) boxes[i / kChildren].add(below[i]);
        levels_.push_back(std::move(boxes));
    }
}

// The frame's box around all that is nearest to the voxels from the first to the last.
Box SurfaceTree::boxOfCubes(const Vec3i& firstVoxel, const Vec3i& lastVoxel) const
{
    const Vec3d centre = frame_ * (0.5 * (firstVoxel.cast<double>() + lastVoxel.cast<double>()));
    const Vec3d half = frame_.cwiseAbs() * (0.5 * (lastVoxel - firstVoxel + Vec3i::Ones()).cast<double>());
    return Box{centre - half, centre + half};
}

std::optional<SurfaceTree::Cube> SurfaceTree::nearest(const Vec3d& index, Cubes cubes) const
{
    if (leaves_.empty()) return std::nullopt;
    Search search;
    search.point = frame_ * index;
    search.cubes = cubes;
    visit(levels_.size() - 1, 0, search);
    if (!(search.bestSquared < std::numeric_limits<double>::infinity())) return std::nullopt;
    search.best.distance = std::sqrt(search.bestSquared);
    return search.best;
}

void SurfaceTree::visit(std::size_t level, std::size_t node, Search& search) const
{
    if (level == 0) {
        const Leaf& leaf = leaves_[node];
        const Vec3d fromFirst = search.point - frame_ * (leaf.origin.cast<double>() + Vec3d::Constant(0.5));
        for (std::uint64_t bits = leaf.*search.cubes; bits != 0; bits &= bits - 1) {
            const int cube = __builtin_ctzll(bits);
            const Vec3d beside = (fromFirst - cubeOffsets_[std::size_t(cube)]).cwiseAbs() - cubeHalf_;
            const double squared = beside.cwiseMax(0.0).squaredNorm();
            if (squared >= search.bestSquared) continue;
            search.bestSquared = squared;
            search.best.voxel = leaf.origin + voxelOf(cube);
        }
        return;
    }
    // Nearest first, so that most of the others are not worth a visit.
    const std::vector<Box>& boxes = levels_[level - 1];
    const std::size_t first = node * kChildren;
    const std::size_t count = std::min(kChildren, boxes.size() - first);
    struct Child {
        double squared;
        std::size_t node;
    };
    Child children[kChildren];
    std::size_t wanted = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Child child{distanceSquared(boxes[first + i], search.point), first + i};
        if (child.squared >= search.bestSquared) continue;
        std::size_t place = wanted++;
        for (; place > 0 && children[place - 1].squared > child.squared; --place) children[place] = children[place - 1];
        children[place] = child;
    }
    for (std::size_t i = 0; i < wanted && children[i].squared < search.bestSquared; ++i) {
        visit(level - 1, children[i].node, search);
    }
}

std::size_t SurfaceTree::memoryBytes() const
{
    std::size_t bytes = leaves_.size() * sizeof(Leaf);
    for (const auto& level : levels_) bytes += level.size() * sizeof(Box);
    return bytes;
}

} // namespace vdbounce
