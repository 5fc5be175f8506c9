// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace vdbounce {

/// A file of a numbered sequence.
struct FrameFile {
    int frame = 0;
    std::string path;
};

/// True when the file's name (not its folder's) has a run of # for the frame.
bool isFramePattern(const std::string& pattern);

/// The files there are for `pattern`, "body.####.obj", by frame. Numbers have as many digits as there are #, more only
/// where they need them, as framePath() writes them. Throws InputError where there is none, and where frames between
/// the first and the last are missing: it names them.
std::vector<FrameFile> findFrames(const std::string& pattern);

} // namespace vdbounce
