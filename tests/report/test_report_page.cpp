// SPDX-License-Identifier: Apache-2.0
#include "report/report_page.h"
#include "report/run_in_page.h"
#include "report/sample_run.h"
#include "support/temporary_folder.h"

#include "vdbounce/base/error.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace vdbounce;
using namespace vdbounce::test;
using report::hasReportPage;
using report::writeReportPage;

namespace {

std::size_t countOf(const std::string& text, const std::string& what)
{
    std::size_t count = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
    return count;
}

std::string writtenPage(const std::string& json, const std::string& command)
{
    const TemporaryFolder folder;
    writeReportPage(json, command, folder / "report.html");
    CHECK(folder.fileCount() == 1);
    return readFile(folder / "report.html");
}

} // namespace

TEST_CASE("a report page holds the run as it is and loads nothing")
{
    if (!hasReportPage()) return;
    const std::string page = writtenPage(sampleRun(), "vdbounce bench trade");
    CHECK_THAT(page, Catch::StartsWith("<!DOCTYPE html>") && Catch::EndsWith("</html>\n"));
    CHECK(nlohmann::json::parse(runInPage(page)) == nlohmann::json::parse(sampleRun()));
    CHECK_THAT(page, Catch::Contains("<code id=\"command\">vdbounce bench trade</code>"));
    CHECK_THAT(page, Catch::Contains("Permission is hereby granted, free of charge"));
    for (const char* loaded : {" src=", "<link", "@import", "url("}) CHECK_THAT(page, !Catch::Contains(loaded));
    for (const char* left : {"{{", "@page_js@", "@uplot_js@", "@page_css@"}) CHECK_THAT(page, !Catch::Contains(left));
}

TEST_CASE("no name in a run nor a command breaks out of the report page")
{
    if (!hasReportPage()) return;
    const std::string plain = writtenPage(R"({"cases":[]})", "vdbounce");
    const nlohmann::json run = {{"machine", "<!-- <script>"},
                                {"cases", {{{"name", "</script><img src=x>\xe2\x80\xa8"}}}}};
    const std::string page = writtenPage(run.dump(), "vdbounce </code><script>alert(1)</script> & more");
    CHECK(nlohmann::json::parse(runInPage(page)) == run);
    for (const char* tag : {"<script", "</script", "<img", "<!--", "</code"}) {
        INFO(tag);
        CHECK(countOf(page, tag) == countOf(plain, tag));
    }
    CHECK_THAT(page, Catch::Contains("&lt;/code>&lt;script>alert(1)&lt;/script> &amp; more"));
}

TEST_CASE("a report page that cannot be written is named, and one that was there stays")
{
    const TemporaryFolder folder;
    CHECK_THROWS_AS(writeReportPage("{}", "vdbounce", folder / "missing/report.html"), RunError);
    if (hasReportPage()) return;
    const std::string older = folder.write("report.html", "older");
    CHECK_THROWS_WITH(writeReportPage("{}", "vdbounce", older),
                      Catch::Contains("no report page") && Catch::Contains("VDBOUNCE_REPORT"));
    CHECK(readFile(older) == "older");
}
