// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vdbounce::test {

struct ToolRun {
    int exitCode = -1;
    std::string out;
    std::string err;
};

/// Runs the vdbounce tool through a shell with these arguments, both outputs being pipes.
ToolRun runTool(const std::string& arguments);

/// The path of a file in the source tree.
std::string sourcePath(const std::string& relative);

/// Number of lines.
std::size_t lineCount(const std::string& text);

} // namespace vdbounce::test
