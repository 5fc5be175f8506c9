// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/temporary_folder.h"

#include "vdbounce/base/error.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

namespace vdbounce::test {

/// A file that cannot be read: what it is called and holds, and what the error must say.
struct BrokenFile {
    const char* name;
    std::string text;
    const char* place; ///< where the error begins: the file's name, and a line
    const char* what;
};

/// Checks that `read`, given its path, refuses each of the files with its place.
template <class Read> void checkRefused(const std::vector<BrokenFile>& files, const Read& read)
{
    const TemporaryFolder folder;
    for (const BrokenFile& file : files) {
        INFO(file.name);
        const std::string path = folder.write(file.name, file.text);
        CHECK_THROWS_AS(read(path), InputError);
        CHECK_THROWS_WITH(read(path), Catch::Contains(folder / file.place) && Catch::Contains(file.what));
    }
}

} // namespace vdbounce::test
