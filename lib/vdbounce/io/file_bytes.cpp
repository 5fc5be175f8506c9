// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/file_bytes.h"

#include "vdbounce/base/error.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace vdbounce {
namespace {

[[noreturn]] void failToOpen(const std::string& path)
{
    throw InputError(path, std::string("cannot be opened (") + std::strerror(errno) + ")",
                     "check the name and the permissions");
}

// Opens for reading and returns the descriptor; throws unless it is a regular file.
int openRegularFile(const std::string& path, std::size_t& size)
{
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) failToOpen(path);
    struct stat status {};
    if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
        ::close(descriptor);
        throw InputError(path, "is not a file", "name a regular file");
    }
    size = static_cast<std::size_t>(status.st_size);
    return descriptor;
}

} // namespace

FileBytes::FileBytes(const std::string& path)
{
    const int descriptor = openRegularFile(path, size_);
    if (size_ > 0) {
        void* mapped = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, descriptor, 0);
        if (mapped == MAP_FAILED) {
            ::close(descriptor);
            failToOpen(path);
        }
        ::madvise(mapped, size_, MADV_SEQUENTIAL);
        data_ = static_cast<const char*>(mapped);
    }
    ::close(descriptor);
}

FileBytes::~FileBytes()
{
    if (data_ != nullptr) ::munmap(const_cast<char*>(data_), size_);
}

void requireReadableFile(const std::string& path)
{
    std::size_t size = 0;
    ::close(openRegularFile(path, size));
}

std::string fileEnding(const std::string& path)
{
    std::string ending = std::filesystem::path(path).extension().string();
    if (!ending.empty()) ending.erase(0, 1);
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    return ending;
}

} // namespace vdbounce
