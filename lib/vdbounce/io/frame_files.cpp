// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/frame_files.h"

#include "vdbounce/base/error.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <optional>

#include <system_error>

namespace vdbounce {
namespace {

namespace fs = std::filesystem;

// More missing frames than these are not listed one by one.
constexpr std::size_t kMostNamed = 8;

// A file's name around its number.
struct NamePattern {
    std::string before;
    std::size_t width = 0; // of the number; 0 where the name has no place for one
    std::string after;

    explicit NamePattern(const std::string& name)
    {
        const std::size_t last = name.rfind('#');
        if (last == std::string::npos) return;
        std::size_t first = last;
        while (first > 0 && name[first - 1] == '#') --first;
        before = name.substr(0, first);
        width = last - first + 1;
        after = name.substr(last + 1);
    }

    std::optional<int> frameOf(const std::string& name) const
    {
        if (name.size() < before.size() + width + after.size() || name.compare(0, before.size(), before) != 0 ||
            name.compare(name.size() - after.size(), after.size(), after) != 0)
            return std::nullopt;
        const std::string digits = name.substr(before.size(), name.size() - before.size() - after.size());
        if (!std::all_of(digits.begin(), digits.end(), [](unsigned char c) { return std::isdigit(c) != 0; }) ||
            (digits.size() > width && digits[0] == '0'))
            return std::nullopt;
        int frame = 0;
        const auto parsed = std::from_chars(digits.data(), digits.data() + digits.size(), frame);
        return parsed.ec == std::errc() ? std::optional<int>(frame) : std::nullopt;
    }
};

std::string missingBetween(const std::vector<FrameFile>& frames)
{
    std::string missing;
    std::size_t named = 0;
    for (std::size_t i = 1; i < frames.size(); ++i) {
        const int from = frames[i - 1].frame + 1;
        const int to = frames[i].frame - 1;
        if (from > to) continue;
        if (++named > kMostNamed) return missing + ", ...";
        missing += (missing.empty() ? "" : ", ") + std::to_string(from) + (to > from ? "-" + std::to_string(to) : "");
    }
    return missing;
}

} // namespace

bool isFramePattern(const std::string& pattern) { return NamePattern(fs::path(pattern).filename().string()).width > 0; }

std::vector<FrameFile> findFrames(const std::string& pattern)
{
    const fs::path folder = fs::path(pattern).parent_path();
    const NamePattern name(fs::path(pattern).filename().string());
    std::vector<FrameFile> frames;
    std::error_code unreadable;
    for (const fs::directory_entry& entry :
         fs::directory_iterator(folder.empty() ? fs::path(".") : folder, unreadable)) {
        const std::string file = entry.path().filename().string();
        if (const std::optional<int> frame = name.frameOf(file)) frames.push_back({*frame, (folder / file).string()});
    }
    if (frames.empty())
        throw InputError(pattern, "there is no file of that name for any frame", "check the name and its #");
    std::sort(frames.begin(), frames.end(), [](const FrameFile& a, const FrameFile& b) { return a.frame < b.frame; });
    const std::string missing = missingBetween(frames);
    if (!missing.empty()) {
        throw InputError(pattern,
                         "of frames " + std::to_string(frames.front().frame) + " to " +
                             std::to_string(frames.back().frame) + " there is no " + missing,
                         "write the missing frames, or move those beyond them elsewhere");
    }
    return frames;
}

} // namespace vdbounce
