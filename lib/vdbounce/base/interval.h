// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vdbounce {

/// A pair lower <= value <= upper around a value that is not known exactly.
struct Interval {
    double lower = 0.0;
    double upper = 0.0;

    bool contains(double value) const { return lower <= value && value <= upper; }
};

} // namespace vdbounce
