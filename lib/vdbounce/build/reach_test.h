// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace vdbounce {

/// An axis-aligned box in floats: x, y, z.
struct FloatBox {
    std::array<float, 3> min;
    std::array<float, 3> max;
};

/// Eight boxes side by side.
struct EightBoxes {
    alignas(32) float min[3][8];
    alignas(32) float max[3][8];
};

/// Tells for each box of a list, by its numbers, which of eight others it comes as near to as `reach`: bit i of
/// `reached` for box i. Squared distances are compared, in floats, the same on every processor.
void findReached(const FloatBox* boxes, const std::uint32_t* list, std::size_t count, const EightBoxes& eight,
                 float reachSquared, std::uint8_t* reached);

} // namespace vdbounce
