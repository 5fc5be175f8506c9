// SPDX-License-Identifier: Apache-2.0
#include "report/report_page.h"
#include "report/sample_run.h"

#include "vdbounce/io/safe_file.h"

#include <cstdio>

/// @file
/// Writes the page of made-up cases that page.py opens in a browser, and the cases by themselves.
/// usage: vdbounce_sample_page PAGE.html CASES.json

int main(int count, char** arguments)
{
    if (count != 3) {
        std::fputs("usage: vdbounce_sample_page PAGE.html CASES.json\n", stderr);
        return 2;
    }
    const std::string run = vdbounce::test::sampleRun();
    vdbounce::report::writeReportPage(run, "vdbounce bench trade bunny.vdb --html <report>.html", arguments[1]);
    vdbounce::writeTextFile(arguments[2], run);
    return 0;
}
