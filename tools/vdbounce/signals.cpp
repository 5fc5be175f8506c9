// SPDX-License-Identifier: Apache-2.0
#include "signals.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/safe_file.h"

#include <atomic>
#include <csignal>

#include <unistd.h>

namespace vdbounce::tool {
namespace {

std::atomic<bool> requested{false};
constexpr int kExitInterrupted = 130;

void onSignal(int /*signal*/)
{
    if (requested.exchange(true)) {
        removeUncommittedFiles();
        ::_exit(kExitInterrupted);
    }
}

} // namespace

void handleInterrupts()
{
    struct sigaction action {};
    action.sa_handler = onSignal;
    action.sa_flags = SA_RESTART;
    ::sigaction(SIGINT, &action, nullptr);
    ::sigaction(SIGTERM, &action, nullptr);
    // A reader that went away shows as a failed write, which is reported like any other.
    std::signal(SIGPIPE, SIG_IGN);
}

void throwIfInterrupted()
{
    if (interruptRequested()) throw Interrupted();
}

bool interruptRequested() { return requested.load(std::memory_order_relaxed); }

} // namespace vdbounce::tool
