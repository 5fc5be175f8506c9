// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/safe_file.h"

#include "vdbounce/base/error.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <unistd.h>

namespace vdbounce {
namespace {

// Open temporary names, where a signal handler can find them without locks or allocation. A file beyond the
// table's size is still written safely; only the handler would not remove it.
constexpr std::size_t kTrackedFiles = 16;
std::array<std::atomic<const char*>, kTrackedFiles> openTemporaries{};

void track(const char* path)
{
    for (auto& slot : openTemporaries) {
        const char* expected = nullptr;
        if (slot.compare_exchange_strong(expected, path)) return;
    }
}

void untrack(const char* path)
{
    for (auto& slot : openTemporaries) {
        const char* expected = path;
        if (slot.compare_exchange_strong(expected, nullptr)) return;
    }
}

// The file that the name stands for, through links. Renaming over a device, a pipe or a folder would replace it by a
// file.
std::string targetOf(const std::string& path)
{
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        throw RunError(path, fs::is_directory(status) ? "is a directory" : "is no regular file and is left as it is",
                       "name a file");
    }
    if (!fs::is_symlink(fs::symlink_status(path, error))) return path;
    const fs::path target = fs::weakly_canonical(path, error);
    return error ? path : target.string();
}

std::string temporaryNameFor(const std::string& path)
{
    static std::atomic<unsigned> counter{0};
    return path + ".part-" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
}

// The permissions an ordinary new file gets; the process's umask narrows them.
constexpr mode_t kFileMode = 0666;

} // namespace

SafeFile::SafeFile(std::string path) : path_(targetOf(path)), temporaryPath_(temporaryNameFor(path_))
{
    descriptor_ = ::open(temporaryPath_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kFileMode);
    if (descriptor_ < 0) fail("cannot create the file");
    track(temporaryPath_.c_str());
}

SafeFile::~SafeFile()
{
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!committed_) ::unlink(temporaryPath_.c_str());
    untrack(temporaryPath_.c_str());
}

void SafeFile::fail(const std::string& what) const
{
    throw RunError(path_, what + " (" + std::strerror(errno) + ")",
                   "check that the folder exists, is writable and has room");
}

void SafeFile::write(const void* data, std::size_t bytes)
{
    const char* next = static_cast<const char*>(data);
    while (bytes > 0) {
        const ssize_t written = ::write(descriptor_, next, bytes);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail("cannot write");
        next += written;
        bytes -= static_cast<std::size_t>(written);
    }
}

void SafeFile::commit()
{
    if (::fsync(descriptor_) != 0) fail("cannot sync to disk");
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) fail("cannot close");
    if (::rename(temporaryPath_.c_str(), path_.c_str()) != 0) fail("cannot rename the finished file");
    committed_ = true;
}

void writeTextFile(const std::string& path, const std::string& text)
{
    SafeFile file(path);
    file.write(text);
    file.commit();
}

void removeUncommittedFiles() noexcept
{
    for (auto& slot : openTemporaries) {
        if (const char* path = slot.load()) ::unlink(path);
    }
}

} // namespace vdbounce
