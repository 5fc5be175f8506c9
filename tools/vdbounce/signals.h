// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vdbounce::tool {

/// From now on the first SIGINT or SIGTERM asks the work to stop at its next good point, and the second ends the
/// process at once with exit code 130; neither leaves a half-written file.
void handleInterrupts();

/// From now on the first signal already ends the process at once, with the line that Interrupted would have been: for
/// work that leaves nothing behind until it is done, so that there is no good point to wait for.
void endAtOnceWhenInterrupted();

/// Throws Interrupted after the first; for the moment before a verb writes what it made.
void throwIfInterrupted();

/// True after the first.
bool interruptRequested();

} // namespace vdbounce::tool
