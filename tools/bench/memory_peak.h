// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace vdbounce::bench {

/// How far the memory that this process holds rises above what it held when this object was made. Freed memory is given
/// back to the system first, so that work pays for all that it needs. The high-water mark belongs to the process: a
/// second object sets it anew.
///
/// Linux only. The kernel counts whole pages and may be wrong by a few dozen of them for each core.
class MemoryPeak {
public:
    MemoryPeak();

    /// Bytes, >= 0; nothing where the system does not let the mark be set.
    std::optional<double> bytes() const;

private:
    std::optional<std::uint64_t> before_; // bytes
};

} // namespace vdbounce::bench
