// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/base/error.h"
#include "vdbounce/base/parallel.h"
#include "vdbounce/io/file_bytes.h"
#include "vdbounce/io/number_text.h"
#include "vdbounce/io/particle_columns.h"
#include "vdbounce/io/particle_file.h"
#include "vdbounce/io/safe_file.h"

#include <string_view>

namespace vdbounce {
namespace {

constexpr std::size_t kRowsPerBlock = 16384; // large enough to hide the cost of a task, small enough to share out

std::string_view trimmed(std::string_view text)
{
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) text.remove_suffix(1);
    return text;
}

// Takes the part before the next comma off `line`.
std::string_view takeCell(std::string_view& line)
{
    const std::size_t comma = line.find(',');
    const std::string_view cell = line.substr(0, comma);
    line = comma == std::string_view::npos ? std::string_view() : line.substr(comma + 1);
    return trimmed(cell);
}

struct Row {
    std::string_view text;
    std::size_t line;
};

std::vector<Row> splitRows(std::string_view text)
{
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF"; // as spreadsheets write it
    if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) text.remove_prefix(kByteOrderMark.size());
    std::vector<Row> rows;
    for (std::size_t line = 1; !text.empty(); ++line) {
        const std::size_t end = text.find('\n');
        const std::string_view row = trimmed(text.substr(0, end));
        if (!row.empty()) rows.push_back({row, line});
        text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    }
    return rows;
}

std::vector<std::string> headerNames(std::string_view header)
{
    std::vector<std::string> names;
    for (bool more = true; more;) {
        more = header.find(',') != std::string_view::npos;
        std::string_view cell = takeCell(header);
        if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
        names.emplace_back(cell);
    }
    return names;
}

void setCell(Particles& particles, std::size_t row, ParticleColumn column, std::string_view cell,
             const std::string& place)
{
    if (column == ParticleColumn::Id) {
        const auto id = parseInteger(cell);
        if (!id) throw InputError(place, "'" + std::string(cell.substr(0, 40)) + "' is no id", "ids are whole numbers");
        particles.id[row] = *id;
        return;
    }
    const auto value = parseDouble(cell);
    if (!value) {
        throw InputError(place,
                         "'" + std::string(cell.substr(0, 40)) + "' in column " + columnName(column) + " is no number",
                         "correct the cell");
    }
    ParticleTable::set(particles, row, column, *value);
}

void readRow(Particles& particles, std::size_t index, const Row& row, const ParticleTable& table,
             const std::string& path)
{
    const auto place = [&] { return path + ":" + std::to_string(row.line); };
    std::string_view rest = row.text;
    const std::vector<int>& columns = table.columns();
    for (std::size_t c = 0; c < columns.size(); ++c) {
        const bool last = rest.find(',') == std::string_view::npos;
        if (last != (c + 1 == columns.size())) {
            throw InputError(place(), "the row has not the header's " + std::to_string(columns.size()) + " columns",
                             "correct the row");
        }
        const std::string_view cell = takeCell(rest);
        if (columns[c] >= 0) setCell(particles, index, static_cast<ParticleColumn>(columns[c]), cell, place());
    }
}

} // namespace

Particles readCsvParticles(const std::string& path)
{
    const FileBytes bytes(path);
    const std::vector<Row> rows = splitRows(bytes.view());
    if (rows.empty()) throw InputError(path, "is empty", "start with a header such as x,y,z");
    const ParticleTable table(headerNames(rows[0].text), path + ":" + std::to_string(rows[0].line));
    Particles particles;
    table.resize(particles, rows.size() - 1);
    forEachIndex(rows.size() - 1, kRowsPerBlock,
                 [&](std::size_t i) { readRow(particles, i, rows[i + 1], table, path); });
    return particles;
}

void writeCsvParticles(const Particles& particles, const std::string& path)
{
    const std::vector<std::size_t> order = orderById(particles);
    const std::vector<ParticleColumn> columns = presentColumns(particles);
    std::vector<std::string> texts(blockCount(order.size(), kRowsPerBlock));
    forEachBlock(order.size(), kRowsPerBlock, [&](std::size_t block, IndexRange range) {
        std::string& text = texts[block];
        for (std::size_t i = range.begin; i < range.end; ++i) {
            for (ParticleColumn column : columns) {
                if (column == ParticleColumn::Id) {
                    appendNumber(text, particles.id[order[i]]);
                } else {
                    appendNumber(text, columnValue(particles, order[i], column));
                }
                text += column == columns.back() ? '\n' : ',';
            }
        }
    });

    SafeFile file(path);
    std::string header;
    for (ParticleColumn column : columns) {
        header += columnName(column);
        header += column == columns.back() ? '\n' : ',';
    }
    file.write(header);
    for (const std::string& text : texts) file.write(text);
    file.commit();
}

} // namespace vdbounce
