// SPDX-License-Identifier: Apache-2.0
#include "support/random.h"

#include "vdbounce/implicit/csg_operation.h"

#include <catch2/catch.hpp>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {
constexpr CsgOperation kOperations[] = {CsgOperation::Union, CsgOperation::Intersection, CsgOperation::Subtraction,
                                        CsgOperation::Complement};
}

TEST_CASE("set operations on numbers are minimum and maximum")
{
    VDBOUNCE_RANDOM(random);
    for (int i = 0; i < 1000; ++i) {
        const double a = random.uniform(-1.0, 1.0);
        const double b = random.uniform(-1.0, 1.0);
        CHECK(combine(CsgOperation::Union, a, b) == std::min(a, b));
        CHECK(combine(CsgOperation::Intersection, a, b) == std::max(a, b));
        CHECK(combine(CsgOperation::Subtraction, a, b) == std::max(a, -b));
        CHECK(combine(CsgOperation::Complement, a, b) == -a);
    }
}

TEST_CASE("a blend is the sharp operation a blend away from the edge, and off by up to a quarter of it at the edge")
{
    VDBOUNCE_RANDOM(random);
    const double blend = 0.3;
    for (CsgOperation operation : {CsgOperation::Union, CsgOperation::Intersection, CsgOperation::Subtraction}) {
        const double side = operation == CsgOperation::Union ? -1.0 : 1.0;
        for (int i = 0; i < 1000; ++i) {
            const double a = random.uniform(-1.0, 1.0);
            const double b = random.uniform(-1.0, 1.0);
            const double apart = operation == CsgOperation::Subtraction ? std::abs(a + b) : std::abs(a - b);
            const double more = side * (combine(operation, a, b, blend) - combine(operation, a, b));
            CHECK(more >= 0.0);
            CHECK(more <= blend / 4.0 + 1e-15);
            CHECK((apart < blend || more == 0.0));
        }
        const double b = operation == CsgOperation::Subtraction ? -0.5 : 0.5;
        CHECK(combine(operation, 0.5, b, blend) == Approx(0.5 + side * blend / 4.0));
    }
}

TEST_CASE("weights are the derivatives of the operation")
{
    VDBOUNCE_RANDOM(random);
    const double step = 1e-6;
    for (CsgOperation operation : kOperations) {
        for (double blend : {0.0, 0.5}) {
            for (int i = 0; i < 500; ++i) {
                const double a = random.uniform(-1.0, 1.0);
                const double b = random.uniform(-1.0, 1.0);
                if (std::abs(std::abs(a) - std::abs(b)) < 2.0 * step) continue;
                const CsgWeights weights = combinationWeights(operation, a, b, blend);
                const auto slope = [&](double da, double db) {
                    return (combine(operation, a + da, b + db, blend) - combine(operation, a - da, b - db, blend)) /
                           (2.0 * step);
                };
                CHECK(weights.a == Approx(slope(step, 0.0)).margin(1e-5));
                CHECK(weights.b == Approx(slope(0.0, step)).margin(1e-5));
                CHECK(std::abs(weights.a) + std::abs(weights.b) == Approx(1.0));
            }
        }
    }
}
