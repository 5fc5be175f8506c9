// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <random>

namespace vdbounce::test {

/// Random numbers for a test. The seed is VDBOUNCE_TEST_SEED or a fixed one; a failing check prints it.
class Random {
public:
    Random()
        : Random(std::getenv("VDBOUNCE_TEST_SEED") != nullptr
                     ? std::strtoull(std::getenv("VDBOUNCE_TEST_SEED"), nullptr, 10)
                     : 20260101)
    {
    }
    explicit Random(std::uint64_t seed) : seed_(seed), engine_(seed_) {}

    std::uint64_t seed() const { return seed_; }
    double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
    Vec3d in(const Box& box)
    {
        return Vec3d(uniform(box.min.x(), box.max.x()), uniform(box.min.y(), box.max.y()),
                     uniform(box.min.z(), box.max.z()));
    }
    Vec3d direction()
    {
        for (;;) {
            const Vec3d v(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
            if (v.squaredNorm() > 0.01 && v.squaredNorm() <= 1.0) return v.normalized();
        }
    }

private:
    std::uint64_t seed_;
    std::mt19937_64 engine_;
};

} // namespace vdbounce::test

/// Declares `random` and shows its seed where a check fails.
#define VDBOUNCE_RANDOM(random)                                                                                        \
    vdbounce::test::Random random;                                                                                     \
    INFO("VDBOUNCE_TEST_SEED=" << random.seed())
