// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/text_heights.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/file_bytes.h"
#include "vdbounce/io/number_text.h"
#include "vdbounce/io/text_cursor.h"

#include <cmath>
#include <limits>
#include <string_view>

namespace vdbounce {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";

std::string_view trimmed(std::string_view text)
{
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

// Takes the part before the next separator off `row`, which is trimmed; 0 as separator stands for any blanks.
std::string_view takeCell(std::string_view& row, char separator)
{
    const std::size_t end = separator != 0 ? row.find(separator) : row.find_first_of(kBlanks);
    const std::string_view cell = trimmed(row.substr(0, end));
    row = end == std::string_view::npos ? std::string_view() : trimmed(row.substr(end + 1));
    return cell;
}

class TextHeights {
public:
    explicit TextHeights(std::string path) : path_(std::move(path)) {}

    void addLine(std::string_view line)
    {
        ++line_;
        std::string_view row = trimmed(line.substr(0, line.find('#')));
        if (row.empty()) return;
        const char separator = separatorOf(row);
        int columns = 0;
        while (!row.empty()) map_.values.push_back(value(takeCell(row, separator), ++columns));
        endRow(columns);
    }

    HeightMap finish()
    {
        if (map_.rows == 0) throw InputError(path_, "holds no numbers", "give a row of heights a line");
        return std::move(map_);
    }

private:
    [[noreturn]] void fail(const std::string& what, const std::string& remedy) const
    {
        throw InputError(path_ + ":" + std::to_string(line_), what, remedy);
    }

    char separatorOf(std::string_view row) const
    {
        const bool commas = row.find(',') != std::string_view::npos;
        const bool semicolons = row.find(';') != std::string_view::npos;
        // Where ';' separates, ',' may be a decimal comma; to guess would halve or double the columns.
        if (commas && semicolons) {
            fail("has both ',' and ';' in a row", "separate by one of them and write decimals with a point");
        }
        return commas ? ',' : semicolons ? ';' : '\0';
    }

    double value(std::string_view cell, int column) const
    {
        const auto place = [&] { return " in column " + std::to_string(column); };
        if (cell.empty()) fail("nothing stands" + place(), "give a number for every column");
        const auto number = parseDouble(cell);
        if (!number) {
            fail(quotedText(cell) + place() + " is no number", "correct it; start lines that hold no heights with '#'");
        }
        if (!std::isfinite(*number)) fail(quotedText(cell) + place() + " is not finite", "give a height there");
        return *number;
    }

    void endRow(int columns)
    {
        if (map_.rows == 0) map_.columns = columns;
        if (columns != map_.columns) {
            fail("the row has " + std::to_string(columns) + " numbers where the first has " +
                     std::to_string(map_.columns),
                 "give all rows as many");
        }
        ++map_.rows;
    }

    std::string path_;
    HeightMap map_;
    std::size_t line_ = 0;
};

} // namespace

HeightMap readTextHeights(const std::string& path)
{
    const FileBytes bytes(path);
    std::string_view text = bytes.view();
    // Each number but the last takes a digit and what separates it, so that counts fit an int where the bytes do.
    if (text.size() / 2 >= std::size_t(std::numeric_limits<int>::max())) {
        throw InputError(path, "has more than four gigabytes of text", "give the heights as a 16-bit png");
    }
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF"; // as spreadsheets write it
    if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) text.remove_prefix(kByteOrderMark.size());
    TextHeights heights(path);
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        heights.addLine(text.substr(0, end));
        text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    }
    return heights.finish();
}

} // namespace vdbounce
