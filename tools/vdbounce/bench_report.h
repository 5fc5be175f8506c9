// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/bench_case.h"
#include "report.h"

#include <string>

/// @file
/// What all kinds of bench print: with --json the machine and the cases, else text.

namespace vdbounce::tool {

Json casesJson(const bench::Cases& cases);
/// A line a case.
std::string casesText(const bench::Cases& cases);

/// Prints a line a case.
void reportCases(const CommonOptions& common, const bench::Cases& cases);

/// Prints `text` for reading in place of a line a case, below the machine.
void reportCases(const CommonOptions& common, const bench::Cases& cases, const std::string& text);

void append(bench::Cases& all, const bench::Cases& cases);

/// --repetitions, which all kinds take.
void addRepetitions(CLI::App& verb, int& repetitions);

} // namespace vdbounce::tool
