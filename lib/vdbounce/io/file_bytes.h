// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace vdbounce {

/// The bytes of a file, mapped into memory read-only for the lifetime of this object.
/// Throws InputError where the file is missing, is not a regular file, or cannot be read.
class FileBytes {
public:
    explicit FileBytes(const std::string& path);
    ~FileBytes();
    FileBytes(const FileBytes&) = delete;
    FileBytes& operator=(const FileBytes&) = delete;

    std::string_view view() const { return {data_, size_}; }

private:
    const char* data_ = nullptr;
    std::size_t size_ = 0;
};

/// Throws InputError when `path` is missing or not a regular file; for code that opens files by name.
void requireReadableFile(const std::string& path);

/// The part behind the last dot in lower case, without the dot: "obj" for "a/B.OBJ".
std::string fileEnding(const std::string& path);

} // namespace vdbounce
