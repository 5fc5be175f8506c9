// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

namespace vdbounce {

/// Errors are told by what 99 of 100 of a sample do not exceed: another sample tells nearly the same, which it does not
/// of the largest.
constexpr double kErrorShare = 0.99;

/// What a share of the values, 0 to 1, does not exceed; 0 of none.
inline double quantile(std::vector<double> values, double share)
{
    if (values.empty()) return 0.0;
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

} // namespace vdbounce
