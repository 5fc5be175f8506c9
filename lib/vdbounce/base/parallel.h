// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <tbb/parallel_for.h>

/// @file
/// Parallel loops whose result has the same bits for any number of threads: the split into blocks depends on
/// the amount of work only, and partial results are combined in the order of the blocks.

namespace vdbounce {

struct IndexRange {
    std::size_t begin;
    std::size_t end;
};

inline std::size_t blockCount(std::size_t count, std::size_t blockSize) { return (count + blockSize - 1) / blockSize; }

inline IndexRange blockRange(std::size_t block, std::size_t count, std::size_t blockSize)
{
    const std::size_t begin = block * blockSize;
    return {begin, begin + blockSize < count ? begin + blockSize : count};
}

/// Calls body(block, range) for every block of `blockSize` indices below `count`, in parallel, in any order.
template <class Body> void forEachBlock(std::size_t count, std::size_t blockSize, const Body& body)
{
    tbb::parallel_for(std::size_t(0), blockCount(count, blockSize),
                      [&](std::size_t block) { body(block, blockRange(block, count, blockSize)); });
}

/// Calls body(i) for every i below `count`, in parallel, in any order.
template <class Body> void forEachIndex(std::size_t count, std::size_t blockSize, const Body& body)
{
    forEachBlock(count, blockSize, [&](std::size_t, IndexRange range) {
        for (std::size_t i = range.begin; i < range.end; ++i) body(i);
    });
}

/// Sums what `body(range)` returns for each block, in the order of the blocks. Partial needs operator+=.
template <class Partial, class Body>
Partial reduceBlocks(std::size_t count, std::size_t blockSize, Partial sum, const Body& body)
{
    std::vector<Partial> partials(blockCount(count, blockSize), sum);
    forEachBlock(count, blockSize, [&](std::size_t block, IndexRange range) { partials[block] = body(range); });
    for (const Partial& partial : partials) sum += partial;
    return sum;
}

} // namespace vdbounce
