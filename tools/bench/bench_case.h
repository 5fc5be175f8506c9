// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace vdbounce::bench {

/// Bytes in the unit "MB" of cases.
constexpr double kMegabyte = 1e6;

/// The same work done by someone else, in the same run.
struct Peer {
    std::string name;
    double value = 0.0;
};

/// One measured figure; where there is a peer, both are the median of the same number of runs, taken in turn.
struct Case {
    std::string name;
    std::string unit;
    double value = 0.0;
    std::optional<Peer> peer;

    /// Peer over ours: above 1 we are ahead.
    double ratio() const { return peer->value / value; }
};

using Cases = std::vector<Case>;

/// A count for the name of a case: "2e6".
inline std::string countText(std::size_t count)
{
    int exponent = 0;
    for (; count >= 10 && count % 10 == 0; count /= 10) ++exponent;
    return std::to_string(count) + "e" + std::to_string(exponent);
}

} // namespace vdbounce::bench
