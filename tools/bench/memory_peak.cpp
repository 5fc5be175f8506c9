// SPDX-License-Identifier: Apache-2.0
#include "bench/memory_peak.h"

#include <algorithm>
#include <fstream>
#include <string>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace vdbounce::bench {
namespace {

constexpr std::uint64_t kBytesPerKilobyte = 1024; // as /proc means "kB"

// What proc(5) says to write to put the high-water mark at what is held now.
constexpr const char* kResetMark = "5";

// A line of /proc/self/status that ends in "kB".
std::optional<std::uint64_t> statusBytes(const std::string& key)
{
    std::ifstream file("/proc/self/status");
    for (std::string line; std::getline(file, line);) {
        if (line.rfind(key + ":", 0) == 0) return std::stoull(line.substr(key.size() + 1)) * kBytesPerKilobyte;
    }
    return std::nullopt;
}

bool resetMark()
{
    std::ofstream file("/proc/self/clear_refs");
    file << kResetMark << std::flush;
    return file.good();
}

} // namespace

MemoryPeak::MemoryPeak()
{
#if defined(__GLIBC__)
    ::malloc_trim(0);
#endif
    if (resetMark()) before_ = statusBytes("VmRSS");
}

std::optional<double> MemoryPeak::bytes() const
{
    const std::optional<std::uint64_t> mark = before_ ? statusBytes("VmHWM") : std::nullopt;
    if (!mark) return std::nullopt;
    return double(std::max(*mark, *before_) - *before_);
}

} // namespace vdbounce::bench
