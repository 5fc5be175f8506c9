// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace vdbounce {

/// Three quarters of the machine's memory, bytes: what work that can tell beforehand what it takes may take where
/// nobody says otherwise.
std::uint64_t defaultMaxMemory();

} // namespace vdbounce
