// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/base/memory_limit.h"

#include <unistd.h>

namespace vdbounce {
namespace {

constexpr double kMemoryShare = 0.75;

} // namespace

std::uint64_t defaultMaxMemory()
{
    return std::uint64_t(kMemoryShare * double(::sysconf(_SC_PHYS_PAGES)) * double(::sysconf(_SC_PAGESIZE)));
}

} // namespace vdbounce
