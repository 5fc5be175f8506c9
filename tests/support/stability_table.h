// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <fstream>
#include <string>

namespace vdbounce::test {

/// Appends a row to the markdown table in the file that VDBOUNCE_STABILITY_TABLE names, if it names one: what was
/// varied, the range in which it held, and the worst that was measured there. docs/stability.md is made of these.
inline void stabilityRow(const std::string& what, const std::string& range, const std::string& error, double worst)
{
    const char* path = std::getenv("VDBOUNCE_STABILITY_TABLE");
    if (path == nullptr) return;
    std::ofstream file(path, std::ios::app);
    file.precision(2);
    file << "| " << what << " | " << range << " | " << error << ": " << worst << " |\n";
}

} // namespace vdbounce::test
