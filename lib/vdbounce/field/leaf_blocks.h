// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace vdbounce {

/// The voxel values of a sparse grid, laid out for lookup rather than for editing.
///
/// Every 8^3 leaf of the grid becomes a block of 11 x 11 x 12 floats: its own voxels and a halo of one voxel below and
/// two above, so that the 4^3 values around any cell of the leaf lie in one block, in rows along z that start together.
/// The rest of space has one value for each 8^3 cell of leaves ("tile"). A directory of two levels finds the block or
/// tile of a voxel: nodes of 16^3 leaves, and an index over the nodes.
///
/// Memory: 5,808 bytes a leaf (2.8 times its voxels) and 16 KiB for each node of 128^3 voxels that has leaves in or
/// next to it.
class LeafBlocks {
public:
    static constexpr int kLeafBits = 3;
    static constexpr int kLeafSide = 1 << kLeafBits;
    static constexpr int kHaloBelow = 1;
    static constexpr int kBlockRows = 11; // kHaloBelow + kLeafSide + 2
    static constexpr int kBlockRow = 12;  // 11 values along z and one for alignment
    static constexpr int kBlockSize = kBlockRows * kBlockRows * kBlockRow;
    static constexpr int kStrideY = kBlockRow;
    static constexpr int kStrideX = kBlockRow * kBlockRows;

    /// `background` fills what is not set.
    explicit LeafBlocks(float background = 0.0f);

    /// What the directory says of the leaf that holds a voxel.
    class Entry {
    public:
        bool isBlock() const { return code_ >= 0; }
        std::size_t block() const { return static_cast<std::size_t>(code_); }
        /// A tile all of whose 26 neighbours are tiles of the same value: the field is constant around it.
        bool isFar() const { return code_ < 0 && (code_ & 1) != 0; }

    private:
        friend class LeafBlocks;
        explicit Entry(std::int32_t code) : code_(code) {}
        std::size_t tile() const { return static_cast<std::size_t>(~code_) >> 1; }
        std::int32_t code_; // a block's number; or ~(2 * tile + near), so that the lowest bit of the code says "far"
    };

    Entry entryAt(const Vec3i& voxel) const { return Entry(codeAt(voxel)); }
    float tileValue(Entry entry) const { return tileValues_[entry.tile()]; }

    /// The values of a block; the value of the leaf's first voxel is at [kHaloBelow] of each axis.
    const float* block(std::size_t number) const { return values_.data() + number * kBlockSize; }
    std::size_t blockCount() const { return values_.size() / kBlockSize; }

    /// Voxel coordinates of the first voxel of each block.
    const std::vector<Vec3i>& origins() const { return origins_; }

    /// The value of any voxel in space.
    float valueAt(const Vec3i& voxel) const;

    /// The largest difference between the values of two tiles that touch.
    float largestTileStep() const { return largestTileStep_; }

    /// True when any voxel of the box [min, max] has a value below `limit`. Costs as much as the box has leaves in
    /// nodes.
    bool anyBelow(const Vec3i& min, const Vec3i& max, float limit) const;

    std::size_t memoryBytes() const;

    // Building, in this order: all leaves, all tiles, link(), then the values of each block in parallel.

    /// Adds the leaf whose first voxel is `origin` and returns its number.
    std::size_t addLeaf(const Vec3i& origin);
    /// Gives all voxels of the box [min, max], made of whole leaves, a tile value; leaves in it are left alone.
    void setTiles(const Vec3i& min, const Vec3i& max, float value);
    /// Marks tiles that border on blocks or on tiles of another value, and reserves the blocks' memory.
    void link();
    float* blockForWriting(std::size_t number) { return values_.data() + number * kBlockSize; }

private:
    static constexpr int kNodeBits = 4; // 16 leaves a side
    static constexpr int kNodeSide = 1 << kNodeBits;
    static constexpr std::size_t kNodeEntries = std::size_t(1) << (3 * kNodeBits);

    struct Node {
        std::int32_t code[kNodeEntries];
    };
    struct NodePlace {
        Vec3i at;
        bool operator==(const NodePlace& other) const { return at == other.at; }
    };
    struct NodePlaceHash {
        std::size_t operator()(const NodePlace& place) const;
    };

    std::int32_t codeAt(const Vec3i& voxel) const;
    std::int32_t nodeAt(const Vec3i& node) const;
    Node& touchNode(const Vec3i& node);
    std::int32_t& touchCode(const Vec3i& leaf);
    std::int32_t tileCodeFor(float value);
    void touchNodesThatMeetOthers();
    bool borderIs(const Vec3i& place, const Vec3i& side, std::int32_t code) const;
    std::vector<std::size_t> entriesNextToOthers(const Vec3i& place, float& tileStep) const;
    void indexNodesDensely();

    // A node's number, or the code of the one tile that fills it. In a dense array over the nodes' box where that is
    // small, which it is but for grids of scattered pieces.
    std::vector<std::int32_t> denseNodes_;
    Vec3i denseMin_ = Vec3i::Zero();
    Vec3i denseSize_ = Vec3i::Zero();
    std::unordered_map<NodePlace, std::int32_t, NodePlaceHash> sparseNodes_;

    std::vector<Node> nodes_;
    std::vector<Vec3i> origins_;
    std::vector<float> values_;
    std::vector<float> tileValues_;
    float largestTileStep_ = 0.0f;
};

} // namespace vdbounce
