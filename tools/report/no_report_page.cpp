// SPDX-License-Identifier: Apache-2.0
#include "report/report_page.h"

#include "vdbounce/base/error.h"

// Compiled in place of report_page.cpp with VDBOUNCE_REPORT=OFF, and with AUTO where uPlot is not to be had.

namespace vdbounce::report {

bool hasReportPage() { return false; }

void writeReportPage(const std::string&, const std::string&, const std::string& path)
{
    throw RunError(path, "this build of vdbounce has no report page",
                   "build with -DVDBOUNCE_REPORT=ON where npm has a network, or use --json");
}

} // namespace vdbounce::report
