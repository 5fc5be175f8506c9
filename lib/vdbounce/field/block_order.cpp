// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/block_order.h"

#include "vdbounce/base/parallel.h"

#include <algorithm>

namespace vdbounce {
namespace {

// Bytes of voxels in a group: what a second-level cache keeps beside points and results. Twice or half of it cost a
// tenth more.
constexpr std::size_t kGroupBytes = std::size_t(96) << 10;

// Bytes of voxels below which random access is cheap enough: most of them stay in a third-level cache.
constexpr std::size_t kCheapBytes = std::size_t(32) << 20;

// Points a block at least: fewer share too little.
constexpr std::size_t kPointsPerBlock = 16;

// Looked at before: stretches of points, spread evenly.
constexpr std::size_t kStretches = 64;

// Points a task of the counting sort: its counters stay in the first-level cache between two of its points.
constexpr std::size_t kPointsPerTask = std::size_t(1) << 17;

constexpr std::size_t kMostGroups = 4096;

std::size_t blockBytes(Storage storage)
{
    const std::size_t value = storage == Storage::Float ? 4 : storage == Storage::Half ? 2 : 1;
    return BlockLayout::kSize * value;
}

std::size_t blocksPerGroup(Storage storage, std::size_t blockCount)
{
    return std::max(kGroupBytes / blockBytes(storage), (blockCount + kMostGroups - 1) / kMostGroups);
}

} // namespace

bool BlockOrder::pays(const VectorField& field, std::size_t blockCount, const Vec3d* points, std::size_t count)
{
    if (blockCount * blockBytes(field.storage) < kCheapBytes || count < kPointsPerBlock * blockCount) return false;
    const std::size_t perGroup = blocksPerGroup(field.storage, blockCount);
    std::size_t inBlocks = 0;
    std::size_t changes = 0;
    for (std::size_t stretch = 0; stretch < kStretches; ++stretch) {
        PointChunk chunk;
        locatePoints(field, points + (count - kPointsPerChunk) / kStretches * stretch, kPointsPerChunk, chunk);
        std::size_t last = std::size_t(-1);
        for (std::int32_t entry : chunk.entry) {
            if (entry < 0) continue;
            const std::size_t group = std::size_t(entry) / perGroup;
            ++inBlocks;
            if (group != last) ++changes;
            last = group;
        }
    }
    return inBlocks > kStretches * kPointsPerChunk / 2 && changes > inBlocks / 4;
}

const std::vector<std::uint32_t>& BlockOrder::order(const VectorField& field, std::size_t blockCount,
                                                    const Vec3d* points, std::size_t count)
{
    const std::size_t perGroup = blocksPerGroup(field.storage, blockCount);
    const std::size_t groupCount = 2 + blockCount / perGroup;
    const std::size_t tasks = vdbounce::blockCount(count, kPointsPerTask);
    groups_.resize(count);
    order_.resize(count);
    places_.assign(tasks * groupCount, 0);
    forEachBlock(count, kPointsPerTask, [&](std::size_t task, IndexRange range) {
        std::uint32_t* counts = places_.data() + task * groupCount;
        PointChunk chunk;
        for (std::size_t begin = range.begin; begin < range.end; begin += kPointsPerChunk) {
            const std::size_t size = std::min(range.end - begin, std::size_t(kPointsPerChunk));
            locatePoints(field, points + begin, int(size), chunk);
            for (std::size_t i = 0; i < size; ++i) {
                const std::size_t group = chunk.entry[i] < 0 ? 0 : 1 + std::size_t(chunk.entry[i]) / perGroup;
                groups_[begin + i] = std::uint16_t(group);
                ++counts[group];
            }
        }
    });
    std::uint32_t place = 0;
    for (std::size_t group = 0; group < groupCount; ++group) {
        for (std::size_t task = 0; task < tasks; ++task) {
            std::uint32_t& first = places_[task * groupCount + group];
            const std::uint32_t size = first;
            first = place;
            place += size;
        }
    }
    forEachBlock(count, kPointsPerTask, [&](std::size_t task, IndexRange range) {
        std::uint32_t* next = places_.data() + task * groupCount;
        for (std::size_t i = range.begin; i < range.end; ++i) order_[next[groups_[i]]++] = std::uint32_t(i);
    });
    return order_;
}

} // namespace vdbounce
