// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace vdbounce {

enum class ByteOrder { Little, Big };

/// The number stored at `bytes` in the given order, on the little-endian machines that Debian's OpenVDB supports.
template <class T> T loadNumber(const char* bytes, ByteOrder order)
{
    char copy[sizeof(T)];
    std::memcpy(copy, bytes, sizeof(T));
    if (order == ByteOrder::Big) std::reverse(copy, copy + sizeof(T));
    T value;
    std::memcpy(&value, copy, sizeof(T));
    return value;
}

} // namespace vdbounce
