// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vdbounce {

/// A file that appears whole or not at all: written under a temporary name beside its final one, synced to disk,
/// then renamed over it by commit(). Destroyed without commit(), it leaves nothing behind and an older file
/// of that name as it was.
///
/// Only regular files are ever replaced: a device, pipe or folder of that name is refused, a link is followed.
/// Throws RunError where the place cannot be written to, naming the file and the system's reason.
class SafeFile {
public:
    explicit SafeFile(std::string path);
    ~SafeFile();
    SafeFile(const SafeFile&) = delete;
    SafeFile& operator=(const SafeFile&) = delete;

    /// Where to write until commit(), for code that opens files by name.
    const std::string& temporaryPath() const { return temporaryPath_; }

    /// Appends bytes. Not to be mixed with writing to temporaryPath() directly.
    void write(const void* data, std::size_t bytes);
    void write(const std::string& text) { write(text.data(), text.size()); }

    /// Syncs and renames. After it the file is there under its final name.
    void commit();

private:
    [[noreturn]] void fail(const std::string& what) const;

    std::string path_;
    std::string temporaryPath_;
    int descriptor_ = -1;
    bool committed_ = false;
};

/// Writes `text` as the file `path`, whole or not at all.
void writeTextFile(const std::string& path, const std::string& text);

/// Removes the temporary files of every SafeFile not yet committed. Callable from a signal handler that ends the
/// process at once; at other times the destructors do this.
void removeUncommittedFiles() noexcept;

} // namespace vdbounce
