// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

/// @file
/// A level set's memory is that of its leaves. Who makes them without knowing how many there will be, because a radius
/// or a band is far larger than a voxel, stops before the machine does.

namespace vdbounce {

/// Of a finished grid: its values, its mask, its place in the tree and on the way down.
constexpr double kBytesPerLeaf = 2300.0;

/// How many leaves of `bytesPerLeaf` fit into `maxMemory` bytes; 0: three quarters of the machine's.
std::uint64_t leavesWithin(std::uint64_t maxMemory, double bytesPerLeaf);

/// Throws UsageError for more than `most`.
void requireLeaves(std::uint64_t count, std::uint64_t most);

} // namespace vdbounce
