// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/leaf_limit.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/memory_limit.h"
#include "vdbounce/io/number_text.h"

namespace vdbounce {

std::uint64_t leavesWithin(std::uint64_t maxMemory, double bytesPerLeaf)
{
    return std::uint64_t(double(maxMemory > 0 ? maxMemory : defaultMaxMemory()) / bytesPerLeaf);
}

void requireLeaves(std::uint64_t count, std::uint64_t most)
{
    if (count <= most) return;
    throw UsageError("the band",
                     "has more than " + numberText(double(most)) + " leaves, which need more memory than is allowed",
                     "use larger voxels, a thinner band, or --max-memory");
}

} // namespace vdbounce
