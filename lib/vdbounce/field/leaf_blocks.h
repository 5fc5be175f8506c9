// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"
#include "vdbounce/field/block_values.h"

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace vdbounce {

/// The voxel values of a sparse grid, laid out for lookup rather than for editing.
///
/// Every 8^3 leaf of the grid becomes a block that holds its own voxels and a halo (see BlockLayout). So does every
/// leaf-sized cell of a tile whose halo is not of one value. The rest of space has one value for each cell ("tile"),
/// and the field is constant around it. A directory of two levels finds the block or tile of a voxel: nodes of 16^3
/// leaves, and an index over the nodes.
///
/// Memory: a block, 5,324 bytes as floats (2.6 times a leaf's voxels), for each leaf and each such cell of a tile, and
/// 16 KiB for each node of 128^3 voxels that has leaves in or next to it.
class LeafBlocks {
public:
    /// `background` fills what is not set.
    explicit LeafBlocks(float background = 0.0f);

    /// What the directory says of the leaf that holds a voxel.
    class Entry {
    public:
        bool isBlock() const { return code_ >= 0; }
        std::size_t block() const { return static_cast<std::size_t>(code_); }

    private:
        friend class LeafBlocks;
        explicit Entry(std::int32_t code) : code_(code) {}
        std::size_t tile() const { return static_cast<std::size_t>(~code_); }
        std::int32_t code_; // a block's number, or ~tile
    };

    Entry entryAt(const Vec3i& voxel) const { return Entry(codeAt(voxel)); }
    float tileValue(Entry entry) const { return tileValues_[entry.tile()]; }

    const BlockValues& values() const { return values_; }
    std::size_t blockCount() const { return origins_.size(); }

    /// Voxel coordinates of the first voxel of each block.
    const std::vector<Vec3i>& origins() const { return origins_; }

    /// The value of any voxel in space.
    float valueAt(const Vec3i& voxel) const;

    /// True when any voxel of the box [min, max] has a value below `limit`. Costs as much as the box has leaves in
    /// nodes.
    bool anyBelow(const Vec3i& min, const Vec3i& max, float limit) const;

    std::size_t memoryBytes() const;

    /// The directory as arrays, for lookups of many points at once. An entry is a block's number or ~tile.
    struct Directory {
        const std::int32_t* nodes; ///< a node's number or, for one filled by a tile, that entry; null for grids of
                                   ///< scattered pieces, whose nodes are not in an array, and of half a million nodes
        Vec3i nodeMin;
        Vec3i nodeSize;
        const std::int32_t* entries; ///< of 16^3 leaves for each node, x slowest
        const float* tileValues;
    };
    Directory directory() const;

    // Building, in this order: all leaves, all tiles, link(), leaves for those tiles that need them, then the values.

    /// Adds the leaf whose first voxel is `origin` and returns its number.
    std::size_t addLeaf(const Vec3i& origin);
    /// Gives all voxels of the box [min, max], made of whole leaves, a tile value; leaves in it are left alone.
    void setTiles(const Vec3i& min, const Vec3i& max, float value);
    /// Completes the directory. Returns the first voxels of the tiles that border on blocks or on tiles of another
    /// value, whose halo may hold more than one value.
    std::vector<Vec3i> link();
    BlockValues& valuesForWriting() { return values_; }

    static constexpr int kNodeBits = 4; // 16 leaves a side

private:
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
    std::vector<Vec3i> tilesNextToOthers(const Vec3i& place) const;
    void indexNodesDensely();

    // A node's number, or the code of the one tile that fills it. In a dense array over the nodes' box where that is
    // small, which it is but for grids of scattered pieces.
    std::vector<std::int32_t> denseNodes_;
    Vec3i denseMin_ = Vec3i::Zero();
    Vec3i denseSize_ = Vec3i::Zero();
    std::unordered_map<NodePlace, std::int32_t, NodePlaceHash> sparseNodes_;

    std::vector<Node> nodes_;
    std::vector<Vec3i> origins_;
    BlockValues values_;
    std::vector<float> tileValues_;
};

} // namespace vdbounce
