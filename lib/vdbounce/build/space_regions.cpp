// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/space_regions.h"

#include "vdbounce/base/disjoint_sets.h"
#include "vdbounce/base/error.h"
#include "vdbounce/io/number_text.h"

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

constexpr double kBytesPerCell = 12.0;         // which leaf it is, its set, and its region
constexpr double kBytesPerLeaf = 512.0 * 12.0; // each voxel's set and region

// Distances are rounded to float; their sum must exceed the way by more than that can be wrong.
constexpr float kRoundingMargin = 1.00001f;

// The box of leaves around all, one leaf wider on each side, and which leaf lies where in it.
class LeafLattice {
public:
    explicit LeafLattice(const BandLeaves& leaves)
    {
        Vec3i high = leaves.front()->leaf;
        low_ = high;
        for (const auto& leaf : leaves) {
            low_ = low_.cwiseMin(leaf->leaf);
            high = high.cwiseMax(leaf->leaf);
        }
        low_ -= Vec3i::Ones();
        size_ = high - low_ + Vec3i::Constant(2);
        leafAt_.assign(static_cast<std::size_t>(size_.x()) * std::size_t(size_.y()) * std::size_t(size_.z()), -1);
        for (std::size_t i = 0; i < leaves.size(); ++i)
            leafAt_[cell(leaves[i]->leaf - low_)] = static_cast<std::int32_t>(i);
    }
    std::size_t cells() const { return leafAt_.size(); }
    const Vec3i& size() const { return size_; }
    const Vec3i& low() const { return low_; }
    template <class Body> void forEachEmpty(const Body& body) const
    {
        for (int x = 0; x < size_.x(); ++x) {
            for (int y = 0; y < size_.y(); ++y) {
                for (int z = 0; z < size_.z(); ++z) {
                    if (leaf(Vec3i(x, y, z)) < 0) body(Vec3i(x, y, z));
                }
            }
        }
    }
    std::size_t cell(const Vec3i& at) const
    {
        return (std::size_t(at.x()) * std::size_t(size_.y()) + std::size_t(at.y())) * std::size_t(size_.z()) +
               std::size_t(at.z());
    }
    std::int32_t leaf(const Vec3i& at) const { return leafAt_[cell(at)]; }

private:
    Vec3i low_;
    Vec3i size_;
    std::vector<std::int32_t> leafAt_;
};

// Joins what lies on the two sides of every face between neighbouring lattice cells. Elements of the sets are all
// voxels of all leaves, then the lattice's cells.
class Joiner {
public:
    Joiner(const BandLeaves& leaves, const LeafLattice& lattice, const Vec3d& voxelSize, DisjointSets& sets)
        : leaves_(leaves), lattice_(lattice), way_(voxelSize.cast<float>() * kRoundingMargin), sets_(sets)
    {
    }

    void run()
    {
        for (std::size_t leaf = 0; leaf < leaves_.size(); ++leaf) joinWithin(leaf);
        const Vec3i& size = lattice_.size();
        for (int x = 0; x < size.x(); ++x) {
            for (int y = 0; y < size.y(); ++y) {
                for (int z = 0; z < size.z(); ++z) {
                    for (int axis = 0; axis < 3; ++axis) {
                        const Vec3i here(x, y, z);
                        if (here[axis] + 1 < size[axis]) joinAcross(here, axis);
                    }
                }
            }
        }
    }

    std::uint32_t element(std::size_t leaf, int voxel) const
    {
        return static_cast<std::uint32_t>(leaf * BandLeaf::kVoxels) + std::uint32_t(voxel);
    }
    std::uint32_t element(const Vec3i& at) const
    {
        return static_cast<std::uint32_t>(leaves_.size() * BandLeaf::kVoxels + lattice_.cell(at));
    }

private:
    static constexpr int kStride[3] = {64, 8, 1};

    void joinVoxels(int axis, std::size_t leafA, int a, std::size_t leafB, int b)
    {
        if (leaves_[leafA]->distance[std::size_t(a)] + leaves_[leafB]->distance[std::size_t(b)] > way_[axis])
            sets_.join(element(leafA, a), element(leafB, b));
    }

    void joinWithin(std::size_t leaf)
    {
        for (int voxel = 0; voxel < BandLeaf::kVoxels; ++voxel) {
            for (int axis = 0; axis < 3; ++axis) {
                const int stride = kStride[axis];
                if ((voxel / stride & 7) < 7) joinVoxels(axis, leaf, voxel, leaf, voxel + stride);
            }
        }
    }

    void joinAcross(const Vec3i& here, int axis)
    {
        Vec3i there = here;
        ++there[axis];
        const std::int32_t a = lattice_.leaf(here);
        const std::int32_t b = lattice_.leaf(there);
        if (a < 0 && b < 0) {
            sets_.join(element(here), element(there));
            return;
        }
        const int stride = kStride[axis];
        for (int voxel = 0; voxel < BandLeaf::kVoxels; ++voxel) {
            if ((voxel / stride & 7) != 0) continue; // voxels of b's first layer; a's last is seven further
            const int last = voxel + 7 * stride;
            // Beyond the band every distance is at least a voxel, so an empty leaf joins whatever touches it.
            if (a < 0) {
                sets_.join(element(here), element(std::size_t(b), voxel));
            } else if (b < 0) {
                sets_.join(element(there), element(std::size_t(a), last));
            } else {
                joinVoxels(axis, std::size_t(a), last, std::size_t(b), voxel);
            }
        }
    }

    const BandLeaves& leaves_;
    const LeafLattice& lattice_;
    const Eigen::Vector3f way_; // from a voxel to the next along each axis, world
    DisjointSets& sets_;
};

} // namespace

void requireLatticeFits(const BandLeaves& leaves, std::uint64_t maxMemory)
{
    if (leaves.empty()) return;
    Vec3i low = leaves.front()->leaf;
    Vec3i high = low;
    for (const auto& leaf : leaves) {
        low = low.cwiseMin(leaf->leaf);
        high = high.cwiseMax(leaf->leaf);
    }
    const double cells = (high - low + Vec3i::Constant(3)).cast<double>().prod();
    const double bytes = cells * kBytesPerCell + double(leaves.size()) * kBytesPerLeaf;
    if (!(bytes > double(maxMemory))) return;
    throw UsageError("the sign",
                     "would take about " + numberText(std::round(bytes * 1e-8) / 10.0) +
                         " GB by flood or rays, which need all the space around the mesh",
                     "use --sign winding, larger voxels, or --max-memory");
}

SpaceRegions::SpaceRegions(const BandLeaves& leaves, const Vec3d& voxelSize) : label_(leaves.size() * BandLeaf::kVoxels)
{
    if (leaves.empty()) return;
    const LeafLattice lattice(leaves);
    const std::size_t elements = label_.size() + lattice.cells();
    if (elements >= 0xffffffffu) {
        throw InputError("mesh",
                         "its band has " + std::to_string(leaves.size()) +
                             " leaves of 8^3 voxels, more than can be told apart",
                         "use larger voxels or a thinner band");
    }
    DisjointSets sets(elements);
    Joiner joiner(leaves, lattice, voxelSize, sets);
    joiner.run();

    constexpr std::uint32_t kNone = 0xffffffffu;
    std::vector<std::uint32_t> regionOfSet(label_.size() + lattice.cells(), kNone);
    for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf) {
        for (int voxel = 0; voxel < BandLeaf::kVoxels; ++voxel) {
            std::uint32_t& region = regionOfSet[sets.find(joiner.element(leaf, voxel))];
            if (region == kNone) {
                region = static_cast<std::uint32_t>(regions_.size());
                regions_.emplace_back();
            }
            label_[joiner.element(leaf, voxel)] = region;
            const float depth = leaves[leaf]->distance[std::size_t(voxel)];
            if (depth > regions_[region].depth) regions_[region] = {leaf, voxel, depth, false};
        }
    }
    // The lattice is wider than the leaves by one, so its corner is outside.
    const std::uint32_t outside = regionOfSet[sets.find(joiner.element(Vec3i::Zero()))];
    if (outside != kNone) regions_[outside].outermost = true;
    lattice.forEachEmpty([&](const Vec3i& at) {
        const std::uint32_t region = regionOfSet[sets.find(joiner.element(at))];
        if (region != kNone && region != outside) emptyLeaves_.push_back({lattice.low() + at, region});
    });
}

} // namespace vdbounce
