// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"

#include <cstdint>

namespace vdbounce {

/// Random numbers by counter: the numbers of particle i depend on the seed and i only, so that particles can be made
/// in any order on any number of threads. Method: SplitMix64 (Steele, Lea, Flood 2014).
class CounterRandom {
public:
    CounterRandom(std::uint64_t seed, std::uint64_t index) : state_(mix(seed + kStep) ^ mix(index * kStep + kStep)) {}

    /// Uniform in [0, 1), with 53 bits.
    double uniform()
    {
        state_ += kStep;
        return static_cast<double>(mix(state_) >> 11) * 0x1p-53;
    }
    Vec3d uniformVector()
    {
        const double x = uniform();
        const double y = uniform();
        return Vec3d(x, y, uniform());
    }

private:
    static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15ULL;
    static std::uint64_t mix(std::uint64_t z)
    {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return z ^ (z >> 31);
    }
    std::uint64_t state_;
};

} // namespace vdbounce
