// SPDX-License-Identifier: Apache-2.0
#include "support/broken_files.h"
#include "support/random.h"
#include "support/temporary_folder.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/height_map.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <zlib.h>

using namespace vdbounce;
using test::TemporaryFolder;

namespace {

std::string bigEndian(std::uint32_t value)
{
    return {char(value >> 24), char(value >> 16), char(value >> 8), char(value)};
}

std::string chunk(const std::string& typeAndData)
{
    const auto* bytes = reinterpret_cast<const Bytef*>(typeAndData.data());
    return bigEndian(std::uint32_t(typeAndData.size() - 4)) + typeAndData +
           bigEndian(std::uint32_t(crc32(0, bytes, uInt(typeAndData.size()))));
}

enum PngColor { kGrey = 0, kRgb = 2, kPalette = 3, kGreyAlpha = 4, kRgba = 6 };

// A PNG file made by its specification: `rows` as stored, each without its filter byte.
std::string png(int width, int bitDepth, PngColor color, const std::vector<std::string>& rows,
                const std::string& before = "")
{
    std::string raw;
    for (const std::string& row : rows) raw += std::string(1, '\0') + row;
    std::string packed(compressBound(uLong(raw.size())), '\0');
    uLongf size = packed.size();
    compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(raw.data()),
             uLong(raw.size()));
    packed.resize(size);
    const std::string header = "IHDR" + bigEndian(std::uint32_t(width)) + bigEndian(std::uint32_t(rows.size())) +
                               std::string{char(bitDepth), char(color), 0, 0, 0};
    return "\x89PNG\r\n\x1a\n" + chunk(header) + before + chunk("IDAT" + packed) + chunk("IEND");
}

std::string bytes(const std::vector<int>& values)
{
    std::string text;
    for (int value : values) text += char(value);
    return text;
}

std::string words(const std::vector<int>& values)
{
    std::string text;
    for (int value : values) text += bytes({value / 256, value % 256});
    return text;
}

HeightMap readBack(const std::string& text)
{
    const TemporaryFolder folder;
    return readHeightMap(folder.write("map.png", text));
}

} // namespace

TEST_CASE("a png's greys are read exactly as stored")
{
    const HeightMap eight = readBack(png(3, 8, kGrey, {bytes({0, 1, 255}), bytes({127, 128, 254})}));
    CHECK(eight.columns == 3);
    CHECK(eight.rows == 2);
    CHECK(eight.values == std::vector<double>{0.0, 1 / 255.0, 1.0, 127 / 255.0, 128 / 255.0, 254 / 255.0});
    CHECK(eight.at(2, 1) == 254 / 255.0);

    const HeightMap sixteen = readBack(png(2, 16, kGrey, {words({0, 1}), words({256, 40000}), words({65534, 65535})}));
    CHECK(sixteen.columns == 2);
    CHECK(sixteen.rows == 3);
    CHECK(sixteen.values ==
          std::vector<double>{0.0, 1 / 65535.0, 256 / 65535.0, 40000 / 65535.0, 65534 / 65535.0, 1.0});

    CHECK(readBack(png(4, 2, kGrey, {"\x1b", "\xe4"})).values ==
          std::vector<double>{0.0, 1 / 3.0, 2 / 3.0, 1.0, 1.0, 2 / 3.0, 1 / 3.0, 0.0});
}

TEST_CASE("a png's gamma changes no height")
{
    const std::string gamma = chunk("gAMA" + bigEndian(45455));
    CHECK(readBack(png(2, 8, kGrey, {bytes({10, 20}), bytes({30, 40})}, gamma)).values ==
          std::vector<double>{10 / 255.0, 20 / 255.0, 30 / 255.0, 40 / 255.0});
}

TEST_CASE("alpha is ignored, and colours give their luminance")
{
    CHECK(readBack(png(2, 8, kGreyAlpha, {bytes({10, 0, 20, 255}), bytes({30, 7, 40, 9})})).values ==
          std::vector<double>{10 / 255.0, 20 / 255.0, 30 / 255.0, 40 / 255.0});
    CHECK(readBack(png(2, 16, kGreyAlpha, {words({1000, 0, 2, 1}), words({3, 2, 4, 60000})})).values ==
          std::vector<double>{1000 / 65535.0, 2 / 65535.0, 3 / 65535.0, 4 / 65535.0});

    const std::vector<std::string> colors = {bytes({255, 0, 0, 0, 255, 0}), bytes({0, 0, 255, 77, 77, 77})};
    const auto check = [](const HeightMap& map) {
        CHECK(map.values[0] == Approx(0.2126));
        CHECK(map.values[1] == Approx(0.7152));
        CHECK(map.values[2] == Approx(0.0722));
        CHECK(map.values[3] == 77 / 255.0);
    };
    check(readBack(png(2, 8, kRgb, colors)));
    check(readBack(png(2, 8, kRgba, {bytes({255, 0, 0, 1, 0, 255, 0, 2}), bytes({0, 0, 255, 3, 77, 77, 77, 4})})));
    const std::string palette = chunk("PLTE" + colors[0] + colors[1]);
    check(readBack(png(2, 8, kPalette, {bytes({0, 1}), bytes({2, 3})}, palette)));
    check(readBack(png(2, 4, kPalette, {"\x01", "\x23"}, palette)));
    // Transparent entries are no other heights.
    check(readBack(png(2, 8, kPalette, {bytes({0, 1}), bytes({2, 3})}, palette + chunk("tRNS" + bytes({0, 9, 200})))));
}

TEST_CASE("a damaged png is refused in one line")
{
    VDBOUNCE_RANDOM(random);
    std::vector<std::string> rows;
    for (int row = 0; row < 12; ++row) {
        rows.emplace_back();
        for (int i = 0; i < 32; ++i) rows.back() += char(int(random.uniform(0, 256)));
    }
    const std::string good = png(16, 16, kGrey, rows);
    const TemporaryFolder folder;
    const auto refuses = [&](const std::string& text) {
        try {
            readHeightMap(folder.write("bad.png", text));
        } catch (const InputError& error) {
            const std::string what = error.what();
            return what.find(folder / "bad.png") == 0 && what.find('\n') == std::string::npos;
        }
        return false;
    };
    CHECK_FALSE(refuses(good));
    for (std::size_t size = 0; size < good.size(); size += 17) {
        INFO("cut to " << size << " of " << good.size());
        CHECK(refuses(good.substr(0, size)));
    }
    // Each chunk's checksum tells of any bit.
    for (std::size_t at = 0; at < good.size(); at += 1 + at / 100) {
        std::string flipped = good;
        flipped[at] = char(flipped[at] ^ (1 << int(random.uniform(0, 8))));
        INFO("a bit of byte " << at << " of " << good.size());
        CHECK(refuses(flipped));
    }
    CHECK(refuses("GIF89a and more"));
}

TEST_CASE("a png whose header claims more pixels than its bytes can hold takes no memory for them")
{
    std::string text = png(16, 16, kGrey, {words(std::vector<int>(16, 5))});
    const std::string honest = "IHDR" + bigEndian(16) + bigEndian(1) + std::string{16, 0, 0, 0, 0};
    const std::string boast = "IHDR" + bigEndian(900000) + bigEndian(900000) + std::string{16, 0, 0, 0, 0};
    const std::size_t at = text.find(chunk(honest));
    REQUIRE(at != std::string::npos);
    text.replace(at, chunk(honest).size(), chunk(boast));
    CHECK_THROWS_WITH(readBack(text), Catch::Contains("too short for the size that it states"));
    CHECK_THROWS_AS(readBack(text), InputError);
}

TEST_CASE("a text grid is separated by commas, semicolons or blanks")
{
    const TemporaryFolder folder;
    const std::vector<double> expected = {0.5, -1.0, 2e3, 4.0, 5.0, 6.25};
    const char* texts[] = {
        "0.5,-1,2e3\n4,5,6.25\n",
        "0.5 ; -1 ;2e3\r\n4;5;6.25",
        "0.5 -1\t2e3\n\n  4   5  6.25  \n",
        "# heights\n0.5,-1,2e3, # first row\n4,5,6.25,\n#end",
        "\xEF\xBB\xBF"
        "+0.5,-1.0,2000\n4,5,6.25\n",
    };
    for (const char* text : texts) {
        INFO(text);
        for (const char* name : {"map.csv", "map.TXT"}) {
            const HeightMap map = readHeightMap(folder.write(name, text));
            CHECK(map.columns == 3);
            CHECK(map.rows == 2);
            CHECK(map.values == expected);
        }
    }
}

TEST_CASE("a broken text grid is refused with its line and column")
{
    const std::vector<test::BrokenFile> files = {
        {"word.csv", "1,2,3\n# remark\n4,five,6\n", "word.csv:3", "'five' in column 2 is no number"},
        {"header.csv", "x,y\n1,2\n3,4\n", "header.csv:1", "start lines that hold no heights with '#'"},
        {"nan.csv", "1,2\n3,nan\n", "nan.csv:2", "'nan' in column 2 is not finite"},
        {"inf.txt", "1 2\n-inf 4\n", "inf.txt:2", "'-inf' in column 1 is not finite"},
        {"short.csv", "1,2,3\n4,5\n", "short.csv:2", "the row has 2 numbers where the first has 3"},
        {"long.txt", "1 2\n4 5\n1 2 3\n", "long.txt:3", "the row has 3 numbers where the first has 2"},
        {"gap.csv", "1,2,3\n4,,6\n", "gap.csv:2", "nothing stands in column 2"},
        {"comma.csv", "1,5;2,5\n3,5;4,5\n", "comma.csv:1", "both ',' and ';'"},
        {"row.txt", "1 2 3\n", "row.txt", "has 3 x 1 heights"},
        {"column.csv", "1\n2\n3\n", "column.csv", "has 1 x 3 heights"},
        {"empty.csv", "", "empty.csv", "holds no numbers"},
        {"remarks.txt", "# 1 2\n# 3 4\n", "remarks.txt", "holds no numbers"},
        {"bytes.txt", "1 \x01\x02\n", "bytes.txt:1", "in column 2 is no number"},
        {"map.tiff", "1 2\n3 4\n", "map.tiff", "'tiff' is no height map format"},
        {"text.png", "1 2\n3 4\n", "text.png", "is no PNG file"},
    };
    test::checkRefused(files, readHeightMap);
    const TemporaryFolder folder;
    CHECK_THROWS_AS(readHeightMap(folder / "missing.csv"), InputError);
    CHECK_THROWS_AS(readBack(png(2, 8, kGrey, {bytes({1, 2})})), InputError);
}
