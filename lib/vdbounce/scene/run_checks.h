// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/scene/run.h"

#include <string>

/// @file
/// What is asked of a scene before anything is read.

namespace vdbounce {

int lastFrameOf(const Scene& scene, const RunOptions& options);

/// The file of particles to start from.
std::string startFile(const Scene& scene, int firstFrame);

bool isWritten(const Scene& scene, int frame, int lastFrame);

/// Throws UsageError for options and values out of range and for an output that is an input; InputError for a file of a
/// sequence that is missing.
void requireRunnable(const Scene& scene, const RunOptions& options);

} // namespace vdbounce
