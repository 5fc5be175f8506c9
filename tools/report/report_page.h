// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

/// @file
/// The page that shows what a measurement found, costs and errors or comparisons; page/page.html is its frame.

namespace vdbounce::report {

/// Whether this build holds the page (VDBOUNCE_REPORT).
bool hasReportPage();

/// Writes one HTML file that shows the run: it holds all that it needs and loads nothing, so that it opens from disk.
///
/// @param json     the run, as `vdbounce bench --json` prints it; valid JSON in UTF-8. Whatever its strings hold
///                 is shown as text
/// @param command  the command line that repeats the run, shown on top
/// @param path     the file, which appears whole or not at all
///
/// Throws RunError where the place cannot be written to, or where the tool was built without the page.
void writeReportPage(const std::string& json, const std::string& command, const std::string& path);

} // namespace vdbounce::report
