// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/huge_page_allocator.h"
#include "vdbounce/field/block_layout.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vdbounce {

/// How a field keeps its values: the choice between memory (which is speed, where points come in random order) and
/// error. M is the largest |phi| in the field; R is the largest difference between values in one leaf and its halo,
/// about 6 voxels for a band of 3.
enum class Storage {
    Float,  ///< as read: 5,324 bytes a leaf
    Half,   ///< 16-bit floats of phi / M: 2,662 bytes a leaf; each value off by at most |phi| / 2048 + 2e-9 M
    Fixed8, ///< 8 bits between the leaf's smallest and largest value: 1,339 bytes a leaf; each value off by R / 510
};

/// Values of all blocks, one after the other.
template <class T> using BlockArray = std::vector<T, HugePageAllocator<T>>;

/// The values of all blocks of a field, stored as one of the above.
class BlockValues {
public:
    /// What a block's bytes stand for: offset + step * byte.
    struct Range {
        float offset = 0.0f;
        float step = 0.0f;
    };

    /// Room for `blocks` blocks of values that are `largest` at most.
    void allocate(Storage storage, std::size_t blocks, float largest);

    /// Stores a block's BlockLayout::kSize values. Returns the largest error of any. Safe for several blocks at once.
    float encode(std::size_t block, const float* values);

    /// All of a block's values, as they were kept.
    void decode(std::size_t block, float* values) const;

    /// The 4^3 values that begin at `offset` in the block's layout, strides 16, 4 and 1.
    void decodeNeighbourhood(std::size_t block, int offset, float (&values)[64]) const;

    float at(std::size_t block, int offset) const;

    /// Of a block's values.
    static std::size_t bytesPerBlock(Storage storage);

    Storage storage() const { return storage_; }
    std::size_t blockCount() const { return blockCount_; }
    std::size_t memoryBytes() const;

    // The values as they lie in memory, for the lookup; of the three only that of the storage in use is not empty.
    const BlockArray<float>& floats() const { return floats_; }
    const BlockArray<std::uint16_t>& halves() const { return halves_; }
    const BlockArray<std::uint8_t>& bytes() const { return bytes_; }
    /// Of bytes: one a block.
    const std::vector<Range>& ranges() const { return ranges_; }
    /// Of halves: value = half * halfUnit, a power of two.
    float halfUnit() const { return halfUnit_; }

private:
    Storage storage_ = Storage::Float;
    std::size_t blockCount_ = 0;
    float halfUnit_ = 1.0f;
    BlockArray<float> floats_;
    BlockArray<std::uint16_t> halves_;
    BlockArray<std::uint8_t> bytes_;
    std::vector<Range> ranges_;
};

} // namespace vdbounce
