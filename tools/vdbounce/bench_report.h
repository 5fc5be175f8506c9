// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/bench_case.h"
#include "report.h"

#include <string>
#include <vector>

/// @file
/// What all kinds of bench print, with --json the machine, the command and the cases, else text; and the page of them.

namespace vdbounce::tool {

Json casesJson(const bench::Cases& cases);
/// A line a case.
std::string casesText(const bench::Cases& cases);

/// What a kind of bench found.
struct BenchRun {
    std::string command; ///< that repeats it
    Json cases;
    std::string text; ///< for reading, below the machine
};

/// Refuses a page that could not be written, before minutes of measuring; an empty path is none.
void requirePage(const std::string& html, const std::vector<std::string>& inputs = {});

/// Prints the machine and the run, and writes the page, if there is to be one.
void reportRun(const CommonOptions& common, BenchRun run, const std::string& html);

void append(bench::Cases& all, const bench::Cases& cases);

/// --repetitions and --html, which all kinds take.
void addRepetitions(CLI::App& verb, int& repetitions);
void addHtml(CLI::App& verb, std::string& html);

} // namespace vdbounce::tool
