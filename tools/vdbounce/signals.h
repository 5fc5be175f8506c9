// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vdbounce::tool {

/// From now on the first SIGINT or SIGTERM asks the work to stop at its next good point, and the second ends the
/// process at once with exit code 130; neither leaves a half-written file.
void handleInterrupts();

/// Throws Interrupted after the first; for the moment before a verb writes what it made.
void throwIfInterrupted();

/// True after the first.
bool interruptRequested();

} // namespace vdbounce::tool
