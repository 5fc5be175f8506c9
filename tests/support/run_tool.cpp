// SPDX-License-Identifier: Apache-2.0
#include "support/run_tool.h"

#include "support/temporary_folder.h"

#include <algorithm>

#include <sys/wait.h>

namespace vdbounce::test {

ToolRun runTool(const std::string& arguments)
{
    const TemporaryFolder folder;
    const std::string command = std::string(VDBOUNCE_TOOL_PATH) + " " + arguments + " 2>'" + (folder / "err") +
                                "' | cat >'" + (folder / "out") + "'; exit ${PIPESTATUS[0]}";
    const std::string script = folder.write("run.sh", command);
    const int status = std::system(("bash '" + script + "'").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readFile(folder / "out"), readFile(folder / "err")};
}

std::string sourcePath(const std::string& relative) { return std::string(VDBOUNCE_SOURCE_DIR) + "/" + relative; }

std::size_t lineCount(const std::string& text) { return std::size_t(std::count(text.begin(), text.end(), '\n')); }

} // namespace vdbounce::test
