// SPDX-License-Identifier: Apache-2.0
#include "support/random.h"

#include "vdbounce/io/number_text.h"

#include <cmath>
#include <cstring>
#include <limits>

using namespace vdbounce;

TEST_CASE("numbers read back to the same bits")
{
    VDBOUNCE_RANDOM(random);
    for (int i = 0; i < 20000; ++i) {
        const double value = std::ldexp(random.uniform(-1, 1), int(random.uniform(-1070, 1020)));
        const auto back = parseDouble(numberText(value));
        REQUIRE(back);
        REQUIRE(std::memcmp(&value, &*back, sizeof(value)) == 0);
    }
    for (double value : {0.0, -0.0, 5e-324, 1.7976931348623157e308, std::numeric_limits<double>::infinity()}) {
        const auto back = parseDouble(numberText(value));
        REQUIRE(back);
        CHECK(std::memcmp(&value, &*back, sizeof(value)) == 0);
    }
}

TEST_CASE("text that is no number is not read as one")
{
    for (const char* text : {"", "x", "1x", "1 ", "+-1", "--1", "0x10", "1,5", "1e"}) CHECK_FALSE(parseDouble(text));
    CHECK(parseDouble("+1.5") == 1.5);
    CHECK_FALSE(parseInteger("1.5"));
    CHECK(parseInteger("-7") == -7);
}

TEST_CASE("lengths are in world units or voxels")
{
    CHECK(parseLength("0.5")->world(0.25) == 0.5);
    CHECK(parseLength("3vx")->world(0.25) == 0.75);
    CHECK(parseLength("0.5")->voxels(0.25) == 2.0);
    for (const char* text : {"vx", "3 vx", "3px", ""}) CHECK_FALSE(parseLength(text));
}
