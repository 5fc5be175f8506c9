// SPDX-License-Identifier: Apache-2.0
#include "support/temporary_folder.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/safe_file.h"

#include <catch2/catch.hpp>

#include <sys/stat.h>

using namespace vdbounce;
using test::TemporaryFolder;

TEST_CASE("a safe file appears at commit and not before")
{
    const TemporaryFolder folder;
    {
        SafeFile file(folder / "a.txt");
        file.write(std::string("whole"));
        CHECK_FALSE(std::filesystem::exists(folder / "a.txt"));
        file.commit();
    }
    CHECK(test::readFile(folder / "a.txt") == "whole");
    CHECK(folder.fileCount() == 1);
}

TEST_CASE("a safe file that is dropped leaves nothing and an older file as it was")
{
    const TemporaryFolder folder;
    folder.write("a.txt", "older");
    {
        SafeFile file(folder / "a.txt");
        file.write(std::string("half"));
    }
    CHECK(test::readFile(folder / "a.txt") == "older");
    CHECK(folder.fileCount() == 1);
}

TEST_CASE("a signal handler can remove what is not committed")
{
    const TemporaryFolder folder;
    SafeFile file(folder / "a.txt");
    CHECK(folder.fileCount() == 1);
    removeUncommittedFiles();
    CHECK(folder.fileCount() == 0);
}

TEST_CASE("a place that cannot be written to is named")
{
    const TemporaryFolder folder;
    CHECK_THROWS_WITH(SafeFile(folder / "no/such/a.txt"),
                      Catch::Contains("no/such/a.txt") && Catch::Contains("cannot create"));
    CHECK_THROWS_AS(SafeFile(folder / ""), RunError);
}

TEST_CASE("a pipe is refused and left as it is, a link is followed")
{
    const TemporaryFolder folder;
    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    CHECK_THROWS_WITH(SafeFile(folder / "pipe"), Catch::Contains("no regular file"));
    CHECK(std::filesystem::is_fifo(folder / "pipe"));

    folder.write("real.txt", "older");
    std::filesystem::create_symlink("real.txt", folder / "link.txt");
    writeTextFile(folder / "link.txt", "newer");
    CHECK(std::filesystem::is_symlink(folder / "link.txt"));
    CHECK(test::readFile(folder / "real.txt") == "newer");
    CHECK(folder.fileCount() == 3);
}
