// SPDX-License-Identifier: Apache-2.0
#include "report/report_page.h"

#include "report/page_parts.h"

#include "vdbounce/io/safe_file.h"

namespace vdbounce::report {
namespace {

// Within JSON '<' occurs in strings only. Written as its code it can neither end the script that holds the JSON
// ("</script") nor keep it from ending ("<!--").
std::string withoutTags(const std::string& json)
{
    std::string text;
    text.reserve(json.size());
    for (const char c : json) {
        if (c == '<') {
            text += "\\u003c";
        } else {
            text += c;
        }
    }
    return text;
}

std::string htmlText(const std::string& plain)
{
    std::string text;
    for (const char c : plain) {
        if (c == '<') {
            text += "&lt;";
        } else if (c == '&') {
            text += "&amp;";
        } else {
            text += c;
        }
    }
    return text;
}

} // namespace

bool hasReportPage() { return true; }

void writeReportPage(const std::string& json, const std::string& command, const std::string& path)
{
    writeTextFile(path, kPageBeforeCommand + htmlText(command) + kPageBeforeRun + withoutTags(json) + kPageAfterRun);
}

} // namespace vdbounce::report
