// SPDX-License-Identifier: Apache-2.0
#include "mesh_bench_table.h"

#include "report.h"

#include <algorithm>
#include <cstdio>

namespace vdbounce::tool {
namespace {

constexpr std::size_t kGap = 2; // blanks between columns

using Row = std::vector<std::string>;

const Row kTitles = {"mesh",     "triangles", "dim",     "CPU s",   "OpenVDB", "ratio",
                     "error vx", "OpenVDB",   "peak MB", "OpenVDB", "grid MB"};

std::string formatted(const char* format, double value)
{
    char text[48];
    std::snprintf(text, sizeof(text), format, value);
    return text;
}

std::string megabytes(const std::optional<double>& bytes)
{
    return bytes ? formatted("%.1f", *bytes / bench::kMegabyte) : "-";
}

Row rowOf(const bench::MeshBenchResult& result)
{
    const bench::MeshFigures& ours = result.ours;
    const bench::MeshFigures& theirs = result.theirs;
    return {result.mesh,
            grouped(result.triangles),
            std::to_string(result.options.dim),
            formatted("%.3f", ours.cpuSeconds),
            formatted("%.3f", theirs.cpuSeconds),
            formatted("%.2f", theirs.cpuSeconds / ours.cpuSeconds),
            formatted("%.1e", ours.largestErrorVx),
            formatted("%.1e", theirs.largestErrorVx),
            megabytes(ours.peakBytes),
            megabytes(theirs.peakBytes),
            megabytes(ours.gridBytes)};
}

// The first column to the left, numbers to the right.
std::string lined(const std::vector<Row>& rows)
{
    std::vector<std::size_t> widths(kTitles.size(), 0);
    for (const Row& row : rows) {
        for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
    }
    std::string text;
    for (const Row& row : rows) {
        text += (text.empty() ? "" : "\n") + row[0] + std::string(widths[0] - row[0].size(), ' ');
        for (std::size_t c = 1; c < row.size(); ++c)
            text += std::string(kGap + widths[c] - row[c].size(), ' ') + row[c];
    }
    return text;
}

} // namespace

std::string meshBenchTable(const std::vector<bench::MeshBenchResult>& results)
{
    std::vector<Row> rows = {kTitles};
    for (const bench::MeshBenchResult& result : results) rows.push_back(rowOf(result));
    return lined(rows);
}

} // namespace vdbounce::tool
